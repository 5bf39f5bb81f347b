// SPDX-License-Identifier: GPL-3.0-or-later
// shizukuView: the stored times of a case in a browser, or in one file that a browser opens.

#include "StoredCase.H"
#include "core/arguments/StopSignals.H"
#include "core/arguments/runApplication.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Progress.H"
#include "liveView/ViewPage.H"
#include "liveView/ViewServer.H"

#include <chrono>
#include <iostream>
#include <thread>

using namespace shizuku;

namespace
{

constexpr unsigned short usualPort = 8091;
constexpr std::size_t shownParticles = 1'000'000, exportedParticles = 40'000;
constexpr std::size_t exportedFrames = 60;
constexpr std::size_t shownSolid = 400'000;

std::string base64(const std::string& bytes)
{
    static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2)/3*4);
    for (std::size_t i = 0; i < bytes.size(); i += 3)
    {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6*k) & 63];
    }
    return text;
}

// The page with the case in it. Of more times than are exported the last of each few.
void exportPage(const StoredCase& stored, const std::filesystem::path& file)
{
    const std::string mark = "/*export*/";
    std::string page = viewPage(), frames, solids;
    const std::size_t stride = (stored.times() + exportedFrames - 1)/exportedFrames;
    Progress progress("Exporting");
    for (std::size_t i = 0; i < stored.times(); i += stride)
    {
        progress.update(double(i)/double(stored.times()));
        const std::string separator = i == 0 ? "\"" : ",\"";
        frames.append(separator).append(base64(stored.frame(i, exportedParticles))).append("\"");
        if (stored.solidChanges()) solids.append(separator).append(base64(stored.solid(i, exportedParticles))).append("\"");
    }
    const std::string solid = stored.solidChanges() ? "solids:[" + solids + "]" : "solid:\"" + base64(stored.solid(0, shownSolid)) + "\"";
    page.replace(page.find(mark), mark.size(), "window.shizukuExport={scene:" + stored.scene(stride) + "," + solid + ",frames:[" + frames + "]};");
    writeAtomically(file, [&](std::ostream& stream) { stream << page; });
    std::cout << "\nWritten: " << file.string() << ", " << page.size()/1000 << " kB\n";
}

void serve(const StoredCase& stored, const Arguments& args)
{
    const StopSignals signals;
    const ViewAddress address = args.found("at") ? ViewAddress::parse(args.get("at")) : ViewAddress{.port = usualPort};
    ViewServer server(address, [&](const ViewCommand& command) -> ViewServer::Answer
    {
        if (command.kind != ViewCommand::Kind::time) throw FatalInputError({}, "A stored case cannot do that", "pbfDroplet -view, for a run");
        const auto index = std::size_t(command.value);
        ViewServer::Answer answer;
        if (stored.solidChanges()) answer.frames.push_back(std::make_shared<const std::string>(stored.solid(index, shownSolid)));
        answer.frames.push_back(std::make_shared<const std::string>(stored.frame(index, shownParticles)));
        return answer;
    });
    server.keep("scene", stored.scene(1));
    server.keep("state", "{\"kind\":\"state\",\"state\":\"stored\"}");
    server.keep("solid", stored.solid(0, shownSolid), true);
    std::cout << "View: " << server.url() << "\nCtrl-C ends it" << std::endl;
    while (signals.received().signal == 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}

int main(int argc, char** argv)
{
    std::vector<Option> options = timeSelectionOptions();
    options.push_back({"at", "[ADDRESS:]PORT", "Address and port of the page (default address: 127.0.0.1)", ""});
    options.push_back({"export", "FILE", "Write the page and the case into one file: up to 60 times, 40,000 particles", ""});
    const ApplicationInfo info
    {
        .name = "shizukuView",
        .summary = "Show the stored times of a case in a browser.",
        .options = options
    };
    return runApplication(argc, argv, info, [](const Arguments& args)
    {
        const StoredCase stored(args);
        if (args.found("export")) exportPage(stored, args.get("export"));
        else serve(stored, args);
    });
}
