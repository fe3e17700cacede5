# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether Octave's `load` takes an HDF5 file: it stops at text of variable length or that is said to be UTF-8, and
skips compounds. Names every dataset that it would not take; exit code 1 if there is one."""
import sys

import h5py

faults = []


def look(path, data):
    if not isinstance(data, h5py.Dataset):
        return
    text = h5py.check_string_dtype(data.dtype)
    if text is not None and (text.length is None or text.encoding != "ascii"):
        faults.append(f"{path}: text of {text}")
    elif data.dtype.kind not in "fiS":
        faults.append(f"{path}: {data.dtype}")


with h5py.File(sys.argv[1]) as file:
    file.visititems(look)
print("\n".join(faults))
sys.exit(bool(faults))
