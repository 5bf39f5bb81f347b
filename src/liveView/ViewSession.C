// SPDX-License-Identifier: GPL-3.0-or-later
#include "liveView/ViewSession.H"

#include "core/messages/Error.H"
#include "liveView/ViewFrame.H"
#include "liveView/ViewPage.H"

#include <chrono>
#include <optional>

namespace shizuku
{

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;

namespace
{

constexpr std::size_t mostWaiting = 64;                 // messages
constexpr std::chrono::seconds patience(10);            // of a request

// In a time that does not depend on where they differ.
bool isSame(std::string_view a, std::string_view b)
{
    if (a.size() != b.size()) return false;
    unsigned char difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned char>(a[i] ^ b[i]);
    return difference == 0;
}

// A browser names the page that a request comes from: it has to be this server's own, under whatever name that is reached (ssh -L).
bool isOfOtherOrigin(const http::request<http::empty_body>& request)
{
    const auto origin = request.find(http::field::origin);
    return origin != request.end() && origin->value() != "http://" + std::string(request[http::field::host]);
}

// One request of a client, as long as it takes.
class Request : public std::enable_shared_from_this<Request>
{
public:
    Request(boost::asio::ip::tcp::socket socket, ViewServer::Loop& loop) : stream_(std::move(socket)), loop_(loop)
    {
        parser_.header_limit(8192);
        parser_.body_limit(0);
    }
    ~Request()
    {
        if (isMine_) loop_.closed();
    }

    void read()
    {
        stream_.expires_after(patience);
        http::async_read(stream_, buffer_, parser_, [self = shared_from_this()](error_code error, std::size_t)
        {
            if (!error) self->answer();
        });
    }

private:
    void answer()
    {
        const auto& request = parser_.get();
        const std::string target(request.target());
        const std::size_t query = std::min(target.find('?'), target.size());
        const std::string path = target.substr(0, query);
        const bool isAllowed = isSame(target.substr(query), "?token=" + loop_.token());

        if (request.method() != http::verb::get) return reply(http::status::method_not_allowed, "This server answers GET alone\n");
        if (path != "/" && path != "/live") return reply(http::status::not_found, "There is nothing here\n");
        if (!isAllowed || isOfOtherOrigin(request)) return reply(http::status::forbidden, "The address lacks the token that the program has printed\n");
        if (path == "/") return reply(http::status::ok, viewPage(), "text/html; charset=utf-8");
        if (!websocket::is_upgrade(request)) return reply(http::status::upgrade_required, "This is a WebSocket\n");
        isMine_ = false;
        std::make_shared<ViewSession>(std::move(stream_), loop_)->begin(request);
    }

    void reply(http::status status, const std::string& body, const char* type = "text/plain; charset=utf-8")
    {
        response_ = {status, 11};
        response_.set(http::field::content_type, type);
        response_.set(http::field::cache_control, "no-store");
        response_.set("Referrer-Policy", "no-referrer");
        response_.set("X-Content-Type-Options", "nosniff");
        response_.set("Content-Security-Policy", "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
            "connect-src 'self' ws:; img-src 'self' data: blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
        response_.keep_alive(false);
        response_.body() = body;
        response_.prepare_payload();
        http::async_write(stream_, response_, [self = shared_from_this()](error_code, std::size_t)
        {
            error_code ignored;
            self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        });
    }

    beast::tcp_stream stream_;
    ViewServer::Loop& loop_;
    beast::flat_buffer buffer_;
    http::request_parser<http::empty_body> parser_;
    http::response<http::string_body> response_;
    bool isMine_ = true;                // the connection: no session has it
};

std::string notice(const std::string& text)
{
    return "{\"kind\":\"notice\",\"text\":" + jsonText(text) + "}";
}

}

void answerRequest(boost::asio::ip::tcp::socket socket, ViewServer::Loop& loop)
{
    std::make_shared<Request>(std::move(socket), loop)->read();
}

ViewSession::ViewSession(beast::tcp_stream stream, ViewServer::Loop& loop) : socket_(std::move(stream)), loop_(loop)
{
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout{patience, std::chrono::seconds(30), true});
    socket_.read_message_max(ViewCommand::longest);
    socket_.auto_fragment(false);               // a frame of the liquid is one of the protocol
}

ViewSession::~ViewSession()
{
    loop_.closed();
}

void ViewSession::begin(const http::request<http::empty_body>& request)
{
    socket_.async_accept(request, [self = shared_from_this()](error_code error)
    {
        if (error) return;
        self->isOpen_ = true;
        self->loop_.enter(self);
        self->read();
    });
}

void ViewSession::read()
{
    socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t)
    {
        if (error) return self->drop();
        const std::string text = beast::buffers_to_string(self->buffer_.data());
        self->buffer_.consume(self->buffer_.size());
        self->take(text);
        if (self->isOpen_) self->read();
    });
}

void ViewSession::take(const std::string& text)
{
    try
    {
        const ViewCommand command = ViewCommand::parse(text);
        if (command.kind == ViewCommand::Kind::next)
        {
            isWaiting_ = true;
            limit_ = std::max<std::size_t>(1, std::size_t(command.value));
            return offer();
        }
        const ViewServer::Answer answer = loop_.obey(command);
        if (!answer.text.empty()) send({std::make_shared<const std::string>(answer.text), false});
        for (const auto& frame : answer.frames) send({frame, true});
    }
    catch (const FatalError& error)
    {
        send({std::make_shared<const std::string>(notice(error.what())), false});
    }
}

void ViewSession::offer()
{
    if (!isWaiting_) return;
    if (sent_ == loop_.newestNumber()) return loop_.want(limit_);
    isWaiting_ = false;
    sent_ = loop_.newestNumber();
    send({loop_.newest(), true});
}

void ViewSession::send(const ViewMessage& message)
{
    if (!isOpen_) return;
    if (outbox_.size() >= mostWaiting) return drop();
    outbox_.push_back(message);
    if (outbox_.size() == 1) write();
}

void ViewSession::write()
{
    socket_.binary(outbox_.front().isBinary);
    socket_.async_write(boost::asio::buffer(*outbox_.front().bytes), [self = shared_from_this()](error_code error, std::size_t)
    {
        if (error) return self->drop();
        self->outbox_.pop_front();
        if (!self->outbox_.empty()) return self->write();
        if (self->isEnding_) self->drop();
    });
}

void ViewSession::finish()
{
    isEnding_ = true;
    if (outbox_.empty()) drop();
}

void ViewSession::drop()
{
    if (!std::exchange(isOpen_, false)) return;
    loop_.leave(this);
    error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(boost::asio::ip::tcp::socket::shutdown_both, ignored);
    beast::get_lowest_layer(socket_).close();
}

}
