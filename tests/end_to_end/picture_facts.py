# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Facts of PNG files of 8 bits per sample, RGB or RGBA, one JSON object per file and line: width, height, colours
(how many there are), pixels (a checksum), and of what is red its share and the mean column."""

import hashlib
import json
import struct
import sys
import zlib


def chunks(data):
    at = 8
    while at < len(data):
        (size,) = struct.unpack(">I", data[at : at + 4])
        body = data[at + 4 : at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size : at + 12 + size])[0] == zlib.crc32(body), "check sum"
        yield body[:4], body[4:]
        at += 12 + size


def paeth(left, above, corner):
    estimate = left + above - corner
    distances = [abs(estimate - value) for value in (left, above, corner)]
    return (left, above, corner)[distances.index(min(distances))]


def unfiltered(rows, stride, samples):
    """The lines of pixels, by the filters of ISO/IEC 15948, clause 9."""
    before = bytes(stride)
    for start in range(0, len(rows), stride + 1):
        kind, line = rows[start], bytearray(rows[start + 1 : start + 1 + stride])
        for i in range(stride):
            left = line[i - samples] if i >= samples else 0
            corner = before[i - samples] if i >= samples else 0
            guess = (0, left, before[i], (left + before[i]) // 2, paeth(left, before[i], corner))[kind]
            line[i] = (line[i] + guess) & 255
        yield bytes(line)
        before = line


def facts(file):
    data = open(file, "rb").read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    parts = list(chunks(data))
    width, height, depth, colour = struct.unpack(">IIBB", parts[0][1][:10])
    assert depth == 8 and colour in (2, 6)
    samples = 3 if colour == 2 else 4
    rows = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    lines = list(unfiltered(rows, width * samples, samples))
    assert len(lines) == height
    colours, red, columns = set(), 0, 0
    for line in lines:
        for x in range(width):
            r, g, b = line[samples * x : samples * x + 3]
            colours.add((r, g, b))
            if r > 2 * max(g, b, 20):
                red, columns = red + 1, columns + x
    return {
        "width": width,
        "height": height,
        "colours": len(colours),
        "pixels": hashlib.sha256(b"".join(lines)).hexdigest(),
        "red": red / (width * height),
        "column": columns / max(red, 1),
    }


for name in sys.argv[1:]:
    print(json.dumps(facts(name)))
