# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""How the figures of the documents look: colours and a grey that can be read on white and on black; no background."""

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE, GREEN, VIOLET, GREY = "#3d85c6", "#e0782f", "#4c9f70", "#a464b8", "#8a8a8a"


def style(salt):
    """Returns matplotlib.pyplot in that style; figures of equal salt have equal names inside, so equal bytes."""
    plt.rcParams.update({
        "svg.hashsalt": salt, "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 10,
        "savefig.transparent": True, "text.color": GREY, "axes.edgecolor": GREY, "axes.labelcolor": GREY,
        "xtick.color": GREY, "ytick.color": GREY, "axes.spines.top": False, "axes.spines.right": False,
        "legend.frameon": False, "legend.labelcolor": GREY, "lines.linewidth": 1.8, "figure.figsize": (6.0, 3.4),
    })
    return plt
