#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ports for tests that must name one before it is opened.

    free_ports.py [COUNT]      prints the first of COUNT free ports in a row [1]
"""
import random
import socket
import sys

# Below those that the system gives to connections: one that has ended keeps its port for a minute.
FIRST, LAST = 20000, 32000


def free_ports(count=1):
    """The first of `count` free ports in a row."""
    while True:
        first = random.randrange(FIRST, LAST)
        try:
            for port in range(first, first + count):
                with socket.socket() as some:
                    some.bind(("127.0.0.1", port))
            return first
        except OSError:
            pass


if __name__ == "__main__":
    print(free_ports(int(sys.argv[1]) if len(sys.argv) > 1 else 1))
