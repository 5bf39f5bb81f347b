// SPDX-License-Identifier: GPL-3.0-or-later
#include "liveView/ViewServer.H"

#include "core/messages/Error.H"
#include "liveView/ViewLoop.H"
#include "liveView/ViewSession.H"

#include <algorithm>
#include <charconv>
#include <random>

namespace shizuku
{

namespace
{

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

std::string randomToken()
{
    static const char* const digits = "0123456789abcdef";
    std::random_device random;
    std::string token;
    for (int word = 0; word < 4; ++word)
    {
        for (unsigned bits = random(), k = 0; k < 8; ++k, bits >>= 4) token += digits[bits & 15];
    }
    return token;
}

bool tryToListen(Tcp::acceptor& acceptor, const asio::ip::address& address, unsigned short port, boost::system::error_code& error)
{
    const Tcp::endpoint endpoint(address, port);
    error = {};
    if (!acceptor.is_open() && acceptor.open(endpoint.protocol(), error)) return false;
    acceptor.set_option(asio::socket_base::reuse_address(true), error);
    return !acceptor.bind(endpoint, error) && !acceptor.listen(asio::socket_base::max_listen_connections, error);
}

}

ViewAddress ViewAddress::parse(const std::string& text)
{
    const std::size_t colon = text.rfind(':');
    ViewAddress address;
    address.mustBeFree = true;
    if (colon != std::string::npos) address.host = text.substr(0, colon);
    const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
    boost::system::error_code noAddress;
    asio::ip::make_address(address.host, noAddress);
    if (error == std::errc() && end == port.data() + port.size() && !noAddress) return address;
    throw FatalInputError({}, "Nothing can listen at '" + text + "'", "a port, 0 to 65535, or an address and a port, such as 0.0.0.0:8090");
}

ViewServer::Loop::Loop(const ViewAddress& address, Handler handler)
    : handler_(std::move(handler)), token_(randomToken())
{
    const auto host = asio::ip::make_address(address.host);
    boost::system::error_code error;
    bool listens = tryToListen(acceptor_, host, address.port, error);
    if (!listens && !address.mustBeFree) listens = tryToListen(acceptor_, host, 0, error);
    if (!listens) throw FatalError("Cannot listen at " + address.host + ":" + std::to_string(address.port) + ": " + error.message());
    accept();
    thread_ = std::thread([this] { context_.run(); });
}

ViewServer::Loop::~Loop()
{
    asio::post(context_, [this]
    {
        boost::system::error_code ignored;
        acceptor_.close(ignored);
        isEnding_ = true;
        for (const auto& session : std::vector(sessions_)) session->finish();
        deadline_.expires_after(std::chrono::seconds(1));
        deadline_.async_wait([this](const boost::system::error_code& stopped) { if (!stopped) context_.stop(); });
        leave(nullptr);
    });
    thread_.join();
    sessions_.clear();
}

std::string ViewServer::Loop::url() const
{
    const Tcp::endpoint at = acceptor_.local_endpoint();
    const std::string host = at.address().is_v6() ? "[" + at.address().to_string() + "]" : at.address().to_string();
    return "http://" + host + ":" + std::to_string(at.port()) + "/?token=" + token_;
}

void ViewServer::Loop::accept()
{
    acceptor_.async_accept([this](const boost::system::error_code& error, Tcp::socket socket)
    {
        if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
        if (!error && open_ < mostClients)
        {
            ++open_;
            boost::system::error_code ignored;
            socket.set_option(Tcp::no_delay(true), ignored);
            answerRequest(std::move(socket), *this);
        }
        accept();               // else the socket is closed here
    });
}

void ViewServer::Loop::enter(const std::shared_ptr<ViewSession>& session)
{
    sessions_.push_back(session);
    count_ = int(sessions_.size());
    for (const auto& [kind, message] : kept_) session->send(message);
}

void ViewServer::Loop::leave(const ViewSession* session)
{
    std::erase_if(sessions_, [&](const auto& one) { return one.get() == session; });
    count_ = int(sessions_.size());
    if (isEnding_ && sessions_.empty()) context_.stop();
}

void ViewServer::Loop::want(std::size_t limit)
{
    wanted_ = std::max<std::size_t>(wanted_, limit);
}

void ViewServer::Loop::keep(const std::string& kind, ViewMessage message, bool isToldNow)
{
    asio::post(context_, [this, kind, isToldNow, message = std::move(message)]
    {
        const auto same = std::find_if(kept_.begin(), kept_.end(), [&](const auto& entry) { return entry.first == kind; });
        if (same == kept_.end()) kept_.emplace_back(kind, message);
        else same->second = message;
        if (!isToldNow) return;
        for (const auto& session : std::vector(sessions_)) session->send(message);
    });
}

void ViewServer::Loop::publish(std::function<std::string()> makeFrame)
{
    wanted_ = 0;
    asio::post(context_, [this, makeFrame = std::move(makeFrame)]
    {
        newest_ = std::make_shared<const std::string>(makeFrame());
        ++newestNumber_;
        for (const auto& session : std::vector(sessions_)) session->offer();
    });
}

ViewServer::ViewServer(const ViewAddress& address, Handler handler) : loop_(std::make_unique<Loop>(address, std::move(handler))) {}
ViewServer::~ViewServer() = default;
std::string ViewServer::url() const { return loop_->url(); }
std::size_t ViewServer::wanted() const { return loop_->wanted(); }
int ViewServer::clients() const { return loop_->clients(); }
void ViewServer::publish(std::function<std::string()> makeFrame) { loop_->publish(std::move(makeFrame)); }

void ViewServer::keep(const std::string& kind, std::string message, bool isBinary)
{
    loop_->keep(kind, {std::make_shared<const std::string>(std::move(message)), isBinary}, true);
}

void ViewServer::keepForLater(const std::string& kind, std::string message)
{
    loop_->keep(kind, {std::make_shared<const std::string>(std::move(message)), false}, false);
}

}
