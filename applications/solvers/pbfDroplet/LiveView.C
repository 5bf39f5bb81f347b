// SPDX-License-Identifier: GPL-3.0-or-later
#include "LiveView.H"

#include "core/messages/Error.H"
#include "liveView/CaseScene.H"
#include "parallel/AllParts.H"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace shizuku
{

namespace
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr double shareOfTime = 0.02;            // that frames may take of the run's
constexpr Clock::duration shortestFrame = 8ms;  // no page draws more
constexpr Clock::duration timePerParticle = 32ns;   // what a GPU sends over its bus is no time of the host's: 250 MB/s at most, of 20,000 and more
constexpr auto lookInterval = 100ms;            // between rows of charts, and looks at files
constexpr auto historyInterval = 1s;            // of the charts' past, for pages that are opened later
constexpr std::size_t mostRows = 1200;
constexpr unsigned short usualPort = 8090;

}

LiveView::LiveView(const Arguments& args, const Time& time, const Liquid& liquid, FlowView& flow)
    : liquid_(liquid), flow_(flow), isOn_(args.found("view") || args.found("viewAt"))
{
    if (!isOn_) return;
    inAllParts(flow.parts(), [&]
    {
        if (flow.parts().part() > 0) return;
        sliders_ = std::make_unique<CaseSliders>(time.casePath());
        const ViewAddress address = args.found("viewAt") ? ViewAddress::parse(args.get("viewAt")) : ViewAddress{.port = usualPort};
        server_ = std::make_unique<ViewServer>(address, [this](const ViewCommand& command) { return obey(command); });
        wallsMove_ = !movedWallsText(time.casePath(), time.value()).empty();
        solidMoves_ = solidMoves(time.casePath());
        keepScene(time);
        keepState("running");
        std::cout << "View: " << server_->url() << std::endl;
    });
}

LiveView::~LiveView()
{
    if (server_) keepState("ended");
}

// In the server's thread.
ViewServer::Answer LiveView::obey(const ViewCommand& command)
{
    const std::lock_guard lock(mutex_);
    switch (command.kind)
    {
        case ViewCommand::Kind::set: sliders_->set(command.name, command.value); break;
        case ViewCommand::Kind::pause: paused_ = true; break;
        case ViewCommand::Kind::run: paused_ = false; break;
        case ViewCommand::Kind::step: paused_ = true; ++steps_; break;
        case ViewCommand::Kind::write: write_ = true; break;
        case ViewCommand::Kind::stop: stop_ = true; break;
        case ViewCommand::Kind::next: break;                            // the server's
        case ViewCommand::Kind::time: throw FatalInputError({}, "A run has no stored times to show", "shizukuView, for a case");
    }
    asked_.notify_all();
    return {};
}

bool LiveView::frameIsDue(const Time& time) const
{
    const bool isAffordable = Clock::now() >= nextFrame_ || !time.running();
    return isAffordable && server_->wanted() > 0 && shownStep_ != time.index() && !isRead_.load(std::memory_order_acquire);
}

LiveView::Orders LiveView::decide(const Time& time, const StopSignals& signals)
{
    if (!server_) return {};
    std::unique_lock lock(mutex_);
    Orders orders;
    orders.stop = std::exchange(stop_, false);
    orders.write = std::exchange(write_, false);
    orders.paused = paused_ && !orders.stop && time.running() && signals.received().signal == 0;
    if (orders.paused && steps_ > 0)
    {
        --steps_;
        orders.paused = false;
    }
    lock.unlock();
    orders.show = frameIsDue(time);
    return orders;
}

void LiveView::attend(Time& time, const FunctionObjects& functions, const StopSignals& signals)
{
    if (!isOn_) return;
    for (;;)
    {
        if (isAsked_) publish();
        const Orders orders = flow_.parts().fold(decide(time, signals));
        if (orders.show) ask(time, functions);
        if (isAsked_ && (orders.paused || !time.running())) publish();
        look(time, functions);
        if (orders.write) time.writeNext();
        if (orders.stop) time.stop();
        if (!orders.paused) break;
        if (!server_) continue;
        keepState("paused");
        std::unique_lock lock(mutex_);
        asked_.wait_for(lock, 20ms, [&] { return !paused_ || steps_ > 0 || stop_; });
    }
    const bool isPaused = [&] { const std::lock_guard lock(mutex_); return paused_; }();
    if (server_ && !isPaused) keepState("running");
}

void LiveView::ask(const Time& time, const FunctionObjects& functions)
{
    const auto start = Clock::now();
    const bool isCut = flow_.parts().parts() > 1;
    if (isCut) flow_.gather();
    if (!server_) return;
    const Liquid& liquid = isCut ? flow_.liquid() : liquid_;
    head_.time = time.value();
    head_.step = time.index();
    head_.spacing = liquid.properties().spacing;
    head_.unit = "m/s";
    head_.numbers = functions.lastNumbers();
    head_.walls = showWalls(time);
    const std::size_t limit = std::max<std::size_t>(server_->wanted(), 1);
    quantised_.ask(liquid, limit);
    isAsked_ = true;
    shownStep_ = time.index();
    const auto took = std::chrono::duration_cast<Clock::duration>((Clock::now() - start)/shareOfTime);
    nextFrame_ = start + std::max(took, shortestFrame + timePerParticle*long(std::min(limit, std::size_t(liquid.owned()))));
}

void LiveView::publish()
{
    const auto start = Clock::now();
    isAsked_ = false;
    const QuantisedLiquid::Taken taken = quantised_.take();
    head_.particles = taken.particles;
    head_.low = taken.low;
    head_.high = taken.high;
    head_.most = taken.mostSpeed;
    isRead_ = true;
    server_->publish([this, head = head_, words = std::string_view(reinterpret_cast<const char*>(taken.words), taken.shown*sizeof(*taken.words))]
    {
        std::string frame = encodeFrame(head, words);
        isRead_.store(false, std::memory_order_release);
        return frame;
    });
    nextFrame_ += std::chrono::duration_cast<Clock::duration>((Clock::now() - start)/shareOfTime);
}

// Those that move: files are read for a frame where there are some. In the middle of an edit constant/walls may be unreadable: then they are shown in a later frame.
std::string LiveView::showWalls(const Time& time)
{
    try
    {
        if (solidMoves_) server_->keep("solid", solidMessage(time.casePath(), time.value(), theta_), true);
        return wallsMove_ ? movedWallsText(time.casePath(), time.value()) : "";
    }
    catch (const FatalInputError&)
    {
        return {};
    }
}

// Now and then: a row of the charts, and what has changed in the files and on the walls.
void LiveView::look(const Time& time, const FunctionObjects& functions)
{
    if (!server_ || Clock::now() < nextLook_) return;
    nextLook_ = Clock::now() + lookInterval;
    const auto numbers = functions.lastNumbers();
    if (!numbers.empty() && looks_++%stride_ == 0)
    {
        rows_.push_back("[" + jsonNumber(time.value()) + "," + jsonNumbers(numbers) + "]");
        if (rows_.size() > mostRows)                                    // half of them, from now on half as often
        {
            for (std::size_t i = 0; 2*i < rows_.size(); ++i) rows_[i] = std::move(rows_[2*i]);
            rows_.resize((rows_.size() + 1)/2);
            stride_ *= 2;
        }
        if (Clock::now() >= nextHistory_)
        {
            nextHistory_ = Clock::now() + historyInterval;
            server_->keepForLater("history", "{\"kind\":\"history\",\"rows\":[" + boost::algorithm::join(rows_, ",") + "]}");
        }
    }
    const bool otherFiles = [&] { const std::lock_guard lock(mutex_); return sliders_->readIfChanged(); }();
    if (otherFiles) keepScene(time);
    const auto& angles = flow_.walls.angles();
    if (angles && angles->particles != theta_)
    {
        theta_ = angles->particles;
        server_->keep("solid", solidMessage(time.casePath(), time.value(), theta_), true);
    }
}

void LiveView::keepScene(const Time& time)
{
    const std::string modifiable = time.modifiable() ? "true" : "false";
    server_->keep("scene", sceneText(time.casePath(), time.value(), "\"mode\":\"live\",\"endTime\":" + jsonNumber(time.endTime()) + ",\"modifiable\":" + modifiable
        + ",\"sliders\":" + sliders_->json()));
}

void LiveView::keepState(const std::string& state)
{
    if (state == state_) return;
    state_ = state;
    server_->keep("state", "{\"kind\":\"state\",\"state\":" + jsonText(state) + "}");
}

}
