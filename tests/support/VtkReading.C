// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkReading.H"

#include <vtkVersionMacros.h>

#include <dlfcn.h>

namespace shizuku::test
{

bool readsAppended()
{
    struct Version { int major, minor, micro; };
    const auto expat = reinterpret_cast<Version (*)()>(dlsym(RTLD_DEFAULT, "XML_ExpatVersionInfo"));
    const bool deferring = !expat || expat().major > 2 || (expat().major == 2 && expat().minor >= 6);
    return !(deferring && VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION == 1);
}

}
