# SPDX-License-Identifier: GPL-2.0-or-later
polargrain_test(csv_table_test unit unit/csv_table_test.cpp LIBS polargrain_common)
