// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/Vector3.H"

#include <sstream>

namespace shizuku
{

std::string str(const Vector3& a)
{
    std::ostringstream text;
    text << '(' << a.x << ' ' << a.y << ' ' << a.z << ')';
    return text.str();
}

}
