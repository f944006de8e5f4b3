#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Searches for inputs that crash, hang or leak, guided by coverage, under the address and undefined-behaviour
# sanitizers (clang and libFuzzer: Debian packages clang and libclang-rt-dev):
#
#   tests/fuzz/fuzz.sh TARGET RUNS [SOURCES and compiler options ...]
#
# TARGET is a file of this folder without .cpp. What is new in coverage is added to corpus/TARGET.inputs (corpus.py), which
# is merged in the end to stay small. An input that fails is left in the current directory as crash-..., with a report.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=$1 runs=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sources=(coupler/protocol/*.cpp common/*.cpp)
read -ra libraries <<<"$(pkg-config --cflags --libs eigen3 fmt libxxhash hdf5 2>/dev/null || pkg-config --cflags --libs eigen3 fmt libxxhash hdf5-serial)"
clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -DMSGPACK_NO_BOOST \
  -I. -I/usr/include/hdf5/serial "tests/fuzz/$target.cpp" "${sources[@]}" "$@" "${libraries[@]}" \
  -o "$work/fuzz"
mkdir -p "$work/found" "$work/merged"
tests/fuzz/corpus.py unpack "tests/fuzz/corpus/$target.inputs" "$work/kept"
"$work/fuzz" -runs="$runs" -max_len=4096 -timeout=10 -rss_limit_mb=1024 -print_final_stats=1 \
  "$work/found" "$work/kept" 2>&1 |
  grep -E '^(Done|stat::|SUMMARY|==.*ERROR|artifact)'
"$work/fuzz" -merge=1 "$work/merged" "$work/kept" "$work/found" >/dev/null 2>&1
tests/fuzz/corpus.py pack "$work/merged" "tests/fuzz/corpus/$target.inputs"
