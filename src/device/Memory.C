// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Memory.H"

#include "core/messages/Error.H"
#include "device/Device.H"
#include "device/KeptMemory.H"

#include <algorithm>
#include <bit>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace shizuku::device
{

namespace
{

// Blocks that nobody uses at present, the last one released behind the others.
class KeptBlocks
{
public:
    // The smallest that is as large, or up to a quarter larger: of these the first in memory. So it does not matter who released which, and after two steps
    // everybody mostly has the same again, as graphs of kernels want it (cuda/LaunchQueue.H).
    Block take(std::size_t bytes)
    {
        const auto isBetter = [](const Block& a, const Block& b) { return a.bytes != b.bytes ? a.bytes < b.bytes : std::less<>()(a.memory, b.memory); };
        auto best = blocks_.end();
        for (auto block = blocks_.begin(); block != blocks_.end(); ++block)
        {
            if (block->bytes >= bytes && block->bytes <= bytes + bytes / 4 && (best == blocks_.end() || isBetter(*block, *best))) best = block;
        }
        if (best == blocks_.end()) return {};
        const Block found = *best;
        blocks_.erase(best);
        return found;
    }

    // Those that are smaller by a fifth at most go: who asked for them asks for more now, or takes what is larger as well. Returns the size of the largest.
    std::size_t dropOutgrown(std::size_t bytes)
    {
        std::size_t largest = 0;
        std::erase_if(blocks_, [&](const Block& block)
        {
            if (block.bytes >= bytes || block.bytes < bytes - bytes / 5) return false;
            largest = std::max(largest, block.bytes);
            deleteBlock(block.memory);
            return true;
        });
        return largest;
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

// Bytes of each block in use.
std::unordered_map<void*, std::size_t>& sizes()
{
    static auto& sizes = *new std::unordered_map<void*, std::size_t>;
    return sizes;
}

// Small blocks come in eight sizes an octave, of a megabyte and more in 32: what changes a little from step to step finds its memory again. Large
// ones come in whole pages: arrays that differ by an entry have the same memory one after the other.
std::size_t sizeOf(std::size_t bytes)
{
    constexpr std::size_t small = std::size_t(1) << 24, medium = std::size_t(1) << 20, least = 256, page = 1 << 16;
    const std::size_t unit = bytes >= small ? page : std::max(std::bit_floor(bytes) / (bytes < medium ? 8 : 32), least);
    return (bytes + unit - 1) / unit * unit;
}

// It is not in use any more. Its bytes.
std::size_t forget(void* memory) noexcept
{
    const auto found = sizes().find(memory);
    const std::size_t bytes = found->second;
    sizes().erase(found);
    deviceCounters().bytes -= bytes;
    return bytes;
}

}

void dropKeptMemory() { kept().dropAll(); }

Block allocate(std::size_t wanted)
{
    if (wanted == 0) return {};
    auto& counters = deviceCounters();
    Block block = kept().take(sizeOf(wanted));
    if (!block.memory)
    {
        const bool hasGrown = kept().dropOutgrown(sizeOf(wanted)) > wanted - wanted / 16;      // by a little: soon it grows again
        block.bytes = sizeOf(hasGrown ? wanted + wanted / 32 : wanted);
        block.memory = newBlock(block.bytes);
    }
    if (!block.memory)
    {
        kept().dropAll();
        block.bytes = sizeOf(wanted);
        block.memory = newBlock(block.bytes);
    }
    if (!block.memory)
    {
        throw FatalError
        (
            "Not enough memory on the device: cannot allocate " + std::to_string(block.bytes >> 20) + " MiB beside the "
          + std::to_string(counters.bytes >> 20) + " MiB in use"
        );
    }
    sizes()[block.memory] = block.bytes;
    counters.bytes += block.bytes;
    counters.peakBytes = std::max(counters.peakBytes, counters.bytes + kept().bytes());
    return block;
}

void release(void* memory) noexcept
{
    if (!memory) return;
    const std::size_t bytes = forget(memory);
    kept().bring({memory, bytes}, deviceCounters().bytes);      // no more than is in use
}

void discard(void* memory) noexcept
{
    if (!memory) return;
    forget(memory);
    deleteBlock(memory);
}

}
