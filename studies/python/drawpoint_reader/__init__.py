# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""The folder of a Drawpoint study, read without the program that made it.

    import drawpoint_reader
    study = drawpoint_reader.open("results/formula_demo")
    runs = study.frame()            # pandas.DataFrame, or columns() without pandas

Nothing in the folder is changed, and it may be read while the study runs. Every row of study.db is held to its
checksum. Values are those of the command export, bit for bit; a run that is left out of models is "failed" here, too.
"""

from .study import Response, Study, StudyError, Variable, open_study
from .study import open_study as open  # noqa: A004 - drawpoint_reader.open, as h5py.File or PIL.Image.open

__all__ = ["Response", "Study", "StudyError", "Variable", "open", "open_study"]
