// SPDX-License-Identifier: GPL-3.0-or-later
#include "Findings.H"

#include <exception>
#include <iostream>
#include <new>

namespace shizuku
{

bool Findings::attempt(const std::function<void()>& task)
{
    try
    {
        task();
        return true;
    }
    catch (const std::bad_alloc&)
    {
        error("There is not enough memory");
    }
    catch (const std::exception& failure)
    {
        error(failure.what());
    }
    return false;
}

void Findings::error(const std::string& message)
{
    if (!errors_.insert(message).second) return;
    std::cout << "***Error " << errors_.size() << ": " << message << (message.ends_with('\n') ? "\n" : "\n\n");
}

void Findings::warn(const std::string& message)
{
    std::cout << "*Warning: " << message << "\n";
}

}
