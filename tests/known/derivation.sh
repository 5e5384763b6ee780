#!/bin/sh
# SPDX-License-Identifier: MIT
# The known answers are what their derivation says, where Python 3 is installed to run it.
. tests/check.sh
if needs "derivation of the known answers" python3; then
    check "derivation of tests/known/kernels.csv" python3 tests/known/derive_kernels.py --check tests/known/kernels.csv
fi
finish "known answers"
