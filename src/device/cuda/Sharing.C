// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Sharing.H"

#include "device/Group.H"
#include "device/cuda/Sharing.H"

namespace shizuku
{

namespace
{
    int wholeIndices = 0;
}

void shareAsOf(int whole) { wholeIndices = whole; }

int sharedAs(int n) { return wholeIndices > 0 ? wholeIndices : n; }

int device::mostOfGroup() { return wholeIndices > 0 ? 1 : Group::most; }

}
