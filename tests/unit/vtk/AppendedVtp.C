// SPDX-License-Identifier: GPL-3.0-or-later
#include "AppendedVtp.H"

#include "core/messages/Error.H"

#include <boost/property_tree/xml_parser.hpp>

#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <cstdint>
#include <cstring>
#include <sstream>

namespace shizuku::test
{

namespace
{

using boost::property_tree::ptree;

void require(bool condition, const std::string& what)
{
    if (!condition) throw FatalError("Not an appended .vtp file: " + what);
}

// The section of the bytes, read from its beginning to its end.
class Section
{
public:
    explicit Section(std::string bytes) : bytes_(std::move(bytes)) {}

    std::size_t position() const { return at_; }
    bool atEnd() const { return at_ == bytes_.size(); }

    std::string take(std::size_t count)
    {
        require(count <= bytes_.size() - at_, "the bytes end too early");
        at_ += count;
        return bytes_.substr(at_ - count, count);
    }

    std::uint64_t number()
    {
        std::uint64_t value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }

private:
    std::string bytes_;
    std::size_t at_ = 0;
};

std::string inflate(const std::string& compressed, std::size_t size)
{
    std::string bytes(size, '\0');
    vtkNew<vtkZLibDataCompressor> zlib;
    const auto* const from = reinterpret_cast<const unsigned char*>(compressed.data());
    auto* const to = reinterpret_cast<unsigned char*>(bytes.data());
    const std::size_t inflated = zlib->Uncompress(from, compressed.size(), to, size);
    require(inflated == size, "a block has another size than its header says");
    return bytes;
}

// Header: number of blocks, size of a block, size of a last block that is smaller (or 0), each block's compressed size.
std::string takeArray(Section& section)
{
    const std::uint64_t blocks = section.number(), size = section.number(), lastSize = section.number();
    std::vector<std::uint64_t> compressed;
    for (std::uint64_t b = 0; b < blocks; ++b) compressed.push_back(section.number());
    std::string bytes;
    for (std::uint64_t b = 0; b < blocks; ++b)
    {
        bytes += inflate(section.take(compressed[b]), b + 1 == blocks && lastSize > 0 ? lastSize : size);
    }
    return bytes;
}

template<class Number> std::vector<double> numbersOf(const std::string& bytes)
{
    require(bytes.size()%sizeof(Number) == 0, "an array ends within a number");
    std::vector<Number> numbers(bytes.size()/sizeof(Number));
    if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return {numbers.begin(), numbers.end()};
}

std::vector<double> numbersOf(const std::string& bytes, const std::string& type)
{
    if (type == "Float32") return numbersOf<float>(bytes);
    if (type == "Float64") return numbersOf<double>(bytes);
    if (type == "Int32") return numbersOf<std::int32_t>(bytes);
    require(type == "Int64", "an array of type " + type);
    return numbersOf<std::int64_t>(bytes);
}

using Arrays = std::map<std::string, AppendedArray>;

// All arrays below an element, in the order of the file.
void takeArrays(const ptree& element, const std::string& name, Section& section, Arrays& arrays)
{
    for (const auto& [childName, child] : element)
    {
        if (childName == "DataArray")
        {
            const std::string key = name + "/" + child.get<std::string>("<xmlattr>.Name");
            require(child.get<std::string>("<xmlattr>.format") == "appended", key + " is not appended");
            require(child.get<std::size_t>("<xmlattr>.offset") == section.position(), "the offset of " + key);
            AppendedArray& array = arrays[key];
            array.type = child.get<std::string>("<xmlattr>.type");
            array.components = child.get("<xmlattr>.NumberOfComponents", 1);
            array.values = numbersOf(takeArray(section), array.type);
        }
        else takeArrays(child, childName, section, arrays);
    }
}

}

std::map<std::string, AppendedArray> readAppendedVtp(const std::string& text)
{
    const std::string opening = "<AppendedData encoding=\"raw\">", closing = "\n  </AppendedData>\n</VTKFile>\n";
    const std::size_t section = text.find(opening), first = text.find('_', section) + 1;
    require(section != text.npos && first != 0 && text.ends_with(closing), "there is no section of raw bytes");

    ptree xml;
    std::istringstream header(text.substr(0, section) + "</VTKFile>");
    boost::property_tree::read_xml(header, xml);
    const ptree& file = xml.get_child("VTKFile");
    require(file.get<std::string>("<xmlattr>.type") == "PolyData", "its type");
    require(file.get<std::string>("<xmlattr>.byte_order") == "LittleEndian", "its byte order is not this machine's");
    require(file.get<std::string>("<xmlattr>.header_type") == "UInt64", "its type of headers");
    require(file.get<std::string>("<xmlattr>.compressor") == "vtkZLibDataCompressor", "its compressor");

    Arrays arrays;
    Section bytes(text.substr(first, text.size() - closing.size() - first));
    takeArrays(file, "VTKFile", bytes, arrays);
    require(bytes.atEnd(), "there are bytes of no array");
    return arrays;
}

}
