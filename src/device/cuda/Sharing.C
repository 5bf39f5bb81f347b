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

bool sharesAsWhole() { return wholeIndices > 0; }

int sharedAs(int n) { return sharesAsWhole() ? wholeIndices : n; }

int device::mostOfGroup() { return sharesAsWhole() ? 1 : Group::most; }

}
