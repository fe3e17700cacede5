# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""The checksums of a store: 64-bit FNV-1a in 16 digits, over texts that each begin with their length."""

import struct


def fnv1a(data):
    value = 0xCBF29CE484222325
    for byte in data:
        value = ((value ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return value


def digits(data):
    return f"{fnv1a(data):016x}"


class RowText:
    """What a row is summed over: texts as they are, numbers by their bits."""

    def __init__(self):
        self._parts = []

    def add(self, text):
        data = text.encode("utf-8", "surrogateescape")
        self._parts.append(str(len(data)).encode() + b":" + data)

    def add_number(self, value):
        self.add(str(struct.unpack("<Q", struct.pack("<d", value))[0]))

    def checksum(self):
        return digits(b"".join(self._parts))
