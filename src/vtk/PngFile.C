// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/PngFile.H"

#include <vtk_png.h>

#include <csetjmp>
#include <cstring>
#include <new>
#include <vector>

namespace shizuku
{

namespace
{

constexpr double densest = 1100;            // bytes of pixels that a byte of the file can stand for; deflate's are 1032 at most

// libpng, reading from memory.
class PngReader
{
public:
    explicit PngReader(const std::string& content)
    :
        content_(content), png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &fail, &ignore))
    {
        if (png_) info_ = png_create_info_struct(png_);
        if (info_) return;
        png_destroy_read_struct(&png_, nullptr, nullptr);
        throw std::bad_alloc();
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    // Samples of 8 or 16 bits from here on, one or three of them a pixel, and perhaps one of transparency.
    void readHeader()
    {
        orThrow([&]
        {
            png_set_read_fn(png_, this, &read);
            png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
            png_read_info(png_, info_);
            png_set_palette_to_rgb(png_);
            png_set_expand_gray_1_2_4_to_8(png_);
            png_set_interlace_handling(png_);
        });
    }
    void update() { orThrow([&] { png_read_update_info(png_, info_); }); }
    void readRows(std::vector<png_bytep>& rows)
    {
        orThrow([&]
        {
            png_read_image(png_, rows.data());
            png_read_end(png_, nullptr);
        });
    }

    std::size_t width() const { return png_get_image_width(png_, info_); }
    std::size_t height() const { return png_get_image_height(png_, info_); }
    std::size_t samples() const { return png_get_channels(png_, info_); }
    std::size_t bytesOfSample() const { return png_get_bit_depth(png_, info_)/8; }
    std::size_t bytesOfRow() const { return png_get_rowbytes(png_, info_); }

private:
    // libpng jumps out of the call where it fails: nothing in it may need a destructor.
    template<class Call>
    void orThrow(const Call& call)
    {
        if (setjmp(png_jmpbuf(png_)) != 0) throw DamagedImage(words_);
        call();
    }

    [[noreturn]] static void fail(png_structp png, png_const_charp words)
    {
        auto& self = *static_cast<PngReader*>(png_get_error_ptr(png));
        std::strncpy(self.words_, words, sizeof(self.words_) - 1);
        png_longjmp(png, 1);
    }
    static void ignore(png_structp, png_const_charp) {}
    static void read(png_structp png, png_bytep to, std::size_t count)
    {
        auto& self = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (count > self.content_.size() - self.at_) png_error(png, "it ends too early");
        std::memcpy(to, self.content_.data() + self.at_, count);
        self.at_ += count;
    }

    const std::string& content_;
    std::size_t at_ = 0;                    // of the bytes that were read
    char words_[200] = {};                  // of libpng's complaint
    png_structp png_;
    png_infop info_ = nullptr;
};

}

GreyImage greyOfPng(const std::string& content)
{
    PngReader png(content);
    png.readHeader();
    const double pixels = double(png.width())*double(png.height());
    if (pixels > mostPixels) throw DamagedImage(std::to_string(png.width()) + " times " + std::to_string(png.height()) + " pixels are too many");
    png.update();
    const std::size_t rowBytes = png.bytesOfRow(), bytes = png.bytesOfSample(), samples = png.samples();
    if (double(rowBytes)*double(png.height()) > densest*double(content.size())) throw DamagedImage("it is too short for its pixels");

    std::vector<png_byte> values(rowBytes*png.height());
    std::vector<png_bytep> rows;
    for (std::size_t row = 0; row < png.height(); ++row) rows.push_back(values.data() + row*rowBytes);
    png.readRows(rows);

    GreyImage result;
    result.width = int(png.width());
    result.height = int(png.height());
    result.grey.reserve(std::size_t(pixels));
    const double white = bytes == 1 ? 255 : 65535;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    {
        for (std::size_t column = 0; column < png.width(); ++column)
        {
            const png_byte* const pixel = *row + column*samples*bytes;
            const auto sample = [&](int s) -> double { return bytes == 1 ? pixel[s] : 256*pixel[2*s] + pixel[2*s + 1]; };
            const double value = samples < 3 ? sample(0) : 0.299*sample(0) + 0.587*sample(1) + 0.114*sample(2);
            result.grey.push_back(float(value/white));
        }
    }
    return result;
}

}
