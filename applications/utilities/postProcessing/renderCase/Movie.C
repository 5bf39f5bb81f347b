// SPDX-License-Identifier: GPL-3.0-or-later
#include "Movie.H"

#include "core/messages/Error.H"
#include "vtk/OutsideProgram.H"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace shizuku
{

namespace
{

// What the kind of file asks for.
std::vector<std::string> encoding(const std::string& extension)
{
    // Sides of the usual mp4 are even. A GIF has a palette of its own, made from what moves.
    if (extension == ".mp4")
    {
        return {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"};
    }
    return {"-vf", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=bayer:bayer_scale=4", "-f", "gif"};
}

}

Movie::Movie(const std::filesystem::path& file, double rate)
: file_(std::filesystem::absolute(file)), folder_(file_.parent_path()/("." + file_.filename().string() + ".pictures")), rate_(rate)
{
    if (file_.extension() != ".mp4" && file_.extension() != ".gif")
    {
        throw FatalInputError({}, "Option -movie has the value '" + file.string() + "'", "a name that ends in .mp4 or .gif");
    }
    if (!(rate > 0 && rate <= 240)) throw FatalInputError({}, "The option -rate is not within its range", "pictures a second, above 0 and up to 240");
    std::filesystem::create_directories(folder_);
    if (runOutsideProgram("ffmpeg", {"-version"}, folder_/"log") == 0) return;
    std::filesystem::remove_all(folder_);
    throw FatalError("Films are made by ffmpeg, which is not installed: install the package ffmpeg, or leave out -movie and get single pictures");
}

Movie::~Movie()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path Movie::picture(std::size_t number) const
{
    char name[32];
    std::snprintf(name, sizeof name, "%08zu.png", number);
    return folder_/name;
}

void Movie::write() const
{
    const auto log = folder_/"log", whole = folder_/"film";
    std::ostringstream rate;
    rate << rate_;
    std::vector<std::string> arguments{"-y", "-loglevel", "error", "-framerate", rate.str(), "-i", (folder_/"%08d.png").string()};
    for (const std::string& word : encoding(file_.extension())) arguments.push_back(word);
    arguments.push_back(whole.string());
    if (runOutsideProgram("ffmpeg", arguments, log) != 0)
    {
        std::ifstream in(log);
        throw FatalError("ffmpeg could not make " + file_.string() + ":\n" + std::string(std::istreambuf_iterator<char>(in), {}));
    }
    std::filesystem::rename(whole, file_);
}

}
