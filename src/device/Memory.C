// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Memory.H"

#include "core/messages/Error.H"
#include "device/Device.H"
#include "device/KeptMemory.H"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace shizuku::device
{

namespace
{

struct Block
{
    void* memory;
    std::size_t bytes;
};

// Blocks that nobody uses at present, the last one released behind the others.
class KeptBlocks
{
public:
    // One of just that size; nullptr where there is none.
    void* take(std::size_t bytes)
    {
        const auto fit = std::find_if(blocks_.rbegin(), blocks_.rend(), [&](const Block& b) { return b.bytes == bytes; });
        if (fit == blocks_.rend()) return nullptr;
        void* const memory = fit->memory;
        blocks_.erase(std::next(fit).base());
        return memory;
    }

    // The oldest ones go where there are too many, or where they hold more than mostBytes.
    void bring(const Block& block, std::size_t mostBytes)
    {
        blocks_.push_back(block);
        constexpr std::size_t most = 256;           // of a step and a mesh: some sixty
        while (blocks_.size() > most || (blocks_.size() > 1 && bytes() > mostBytes)) dropOldest();
    }

    void dropAll()
    {
        while (!blocks_.empty()) dropOldest();
    }

    std::size_t bytes() const
    {
        std::size_t sum = 0;
        for (const Block& block : blocks_) sum += block.bytes;
        return sum;
    }

private:
    void dropOldest()
    {
        deleteBlock(blocks_.front().memory);
        blocks_.erase(blocks_.begin());
    }

    std::vector<Block> blocks_;
};

// To the end of the process: buffers may live as long.
KeptBlocks& kept()
{
    static KeptBlocks& blocks = *new KeptBlocks;
    return blocks;
}

// Small blocks come in eight sizes an octave, of a megabyte and more in 32: what changes a little from step to step finds its memory again. Large
// ones come in whole pages: arrays that differ by an entry have the same memory one after the other.
std::size_t sizeOf(std::size_t bytes)
{
    constexpr std::size_t small = std::size_t(1) << 24, medium = std::size_t(1) << 20, least = 256, page = 1 << 16;
    const std::size_t unit = bytes >= small ? page : std::max(std::bit_floor(bytes) / (bytes < medium ? 8 : 32), least);
    return (bytes + unit - 1) / unit * unit;
}

}

void dropKeptMemory() { kept().dropAll(); }

void* allocate(std::size_t wanted)
{
    if (wanted == 0) return nullptr;
    const std::size_t bytes = sizeOf(wanted);
    auto& counters = deviceCounters();
    void* memory = kept().take(bytes);
    if (!memory) memory = newBlock(bytes);
    if (!memory)
    {
        kept().dropAll();
        memory = newBlock(bytes);
    }
    if (!memory)
    {
        throw FatalError
        (
            "Not enough memory on the device: cannot allocate " + std::to_string(bytes >> 20) + " MiB beside the "
          + std::to_string(counters.bytes >> 20) + " MiB in use"
        );
    }
    counters.bytes += bytes;
    counters.peakBytes = std::max(counters.peakBytes, counters.bytes + kept().bytes());
    return memory;
}

void release(void* memory, std::size_t wanted) noexcept
{
    if (!memory) return;
    const std::size_t bytes = sizeOf(wanted);
    deviceCounters().bytes -= bytes;
    kept().bring({memory, bytes}, deviceCounters().bytes);      // no more than is in use
}

void discard(void* memory, std::size_t wanted) noexcept
{
    if (!memory) return;
    deleteBlock(memory);
    deviceCounters().bytes -= sizeOf(wanted);
}

}
