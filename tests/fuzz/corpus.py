#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A corpus is one file: of each input the number of its bytes (four, the lowest first) and its bytes.

    corpus.py unpack corpus/TARGET.inputs DIRECTORY     a file an input, as libFuzzer wants it
    corpus.py pack DIRECTORY corpus/TARGET.inputs       in the order of the bytes: the same inputs give the same file
"""
import hashlib
import pathlib
import struct
import sys


def unpack(corpus, directory):
    content = corpus.read_bytes() if corpus.exists() else b""
    directory.mkdir(parents=True, exist_ok=True)
    while content:
        (size,) = struct.unpack_from("<I", content)
        data, content = content[4:4 + size], content[4 + size:]
        (directory / hashlib.sha1(data).hexdigest()).write_bytes(data)


def pack(directory, corpus):
    inputs = sorted({file.read_bytes() for file in directory.iterdir()})
    corpus.write_bytes(b"".join(struct.pack("<I", len(data)) + data for data in inputs))
    print(f"{corpus.name}: {len(inputs)} inputs, {corpus.stat().st_size} bytes")


if __name__ == "__main__":
    {"unpack": unpack, "pack": pack}[sys.argv[1]](pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
