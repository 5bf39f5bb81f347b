// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/DeviceLink.H"

#include "device/Profile.H"

namespace shizuku
{

namespace
{

class HostLink : public DeviceLink
{
public:
    explicit HostLink(const Communicator& parts) : parts_(parts) {}

    void exchange(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const override
    {
        const device::Timed waits(device::waitForGhosts);
        parts_.exchange(sent, received);
    }

    void begin(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const override { parts_.begin(sent, received); }

    void end() const override
    {
        const device::Timed waits(device::waitForGhosts);
        parts_.end();
    }

private:
    const Communicator& parts_;
};

}

std::shared_ptr<const DeviceLink> linkDevices(const Communicator& parts)
{
    return std::make_shared<HostLink>(parts);
}

}
