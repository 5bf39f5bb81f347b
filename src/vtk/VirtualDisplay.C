// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/VirtualDisplay.H"

#include "core/messages/Error.H"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shizuku
{

namespace
{

bool rendersThroughX()
{
    const vtkNew<vtkRenderWindow> window;
    return std::string(window->GetClassName()) == "vtkXOpenGLRenderWindow";
}

// In the child: becomes Xvfb, which writes the number of its display to `report` as soon as it takes clients. The number is of this process: of two servers that look
// for the first free one, one that ends takes away the other's socket.
[[noreturn]] void becomeServer(int report)
{
    prctl(PR_SET_PDEATHSIG, SIGTERM);       // no server is left behind by a killed program
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    constexpr int first = 100, most = 50000;
    const std::string descriptor = std::to_string(report), display = ":" + std::to_string(first + getpid() % most);
    execlp
    (
        "Xvfb", "Xvfb", display.c_str(), "-displayfd", descriptor.c_str(), "-screen", "0", "640x480x24", "-nolisten", "tcp",
        static_cast<char*>(nullptr)
    );
    _exit(127);
}

// What the server writes until it ends the line; empty where it did not start.
std::string readLine(int descriptor)
{
    std::string line;
    char character;
    while (read(descriptor, &character, 1) == 1 && character != '\n') line += character;
    return line;
}

}

VirtualDisplay::VirtualDisplay()
{
    if (!rendersThroughX()) return;

    int ends[2];
    if (pipe(ends) != 0) throw FatalError("No pipe to a virtual display can be made");
    server_ = fork();
    if (server_ == 0)
    {
        close(ends[0]);
        becomeServer(ends[1]);
    }
    close(ends[1]);
    const std::string number = server_ > 0 ? readLine(ends[0]) : "";
    close(ends[0]);
    if (!number.empty())
    {
        setenv("DISPLAY", (":" + number).c_str(), 1);
        return;
    }

    if (server_ > 0) waitpid(server_, nullptr, 0);
    server_ = 0;
    if (!std::getenv("DISPLAY"))
    {
        throw FatalError
        (
            "This VTK renders through X, and there is neither a display nor Xvfb, the virtual one: "
            "install the package xvfb"
        );
    }
}

VirtualDisplay::~VirtualDisplay()
{
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
}

}
