// SPDX-License-Identifier: GPL-3.0-or-later
// The server as a client without manners finds it: over sockets of its own.

#include "liveView/ViewServer.H"

#include "core/messages/Error.H"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

using namespace shizuku;

namespace
{

class Client
{
public:
    explicit Client(unsigned short port) : socket_(::socket(AF_INET, SOCK_STREAM, 0))
    {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const timeval patience{5, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
        isConnected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    ~Client()
    {
        if (socket_ >= 0) ::close(socket_);
    }
    Client(Client&& other) noexcept : socket_(std::exchange(other.socket_, -1)), isConnected_(other.isConnected_) {}
    Client& operator=(Client&&) = delete;

    bool isConnected() const { return isConnected_; }
    void send(const std::string& bytes) const { ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }

    // All up to the end of the connection, or `until`.
    std::string receive(const std::string& until = {}) const
    {
        std::string text;
        char bytes[4096];
        for (ssize_t n; (n = ::recv(socket_, bytes, sizeof bytes, 0)) > 0;)
        {
            text.append(bytes, std::size_t(n));
            if (!until.empty() && text.find(until) != std::string::npos) break;
        }
        return text;
    }

private:
    int socket_;
    bool isConnected_ = false;
};

// A text frame as a client sends it: masked, here by zeros.
std::string textFrame(const std::string& text)
{
    std::string frame = "\x81";
    if (text.size() < 126) frame += char(0x80 | text.size());
    else frame.append(1, char(0xfe)).append(1, char(text.size() >> 8)).append(1, char(text.size() & 255));
    return frame.append(4, '\0') + text;
}

bool comesTrue(const std::function<bool()>& condition)
{
    for (int i = 0; i < 500; ++i)               // 5 s
    {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

class ViewServerTest : public testing::Test
{
protected:
    ViewServerTest()
        : server_({}, [this](const ViewCommand& command) -> ViewServer::Answer
        {
            if (command.kind == ViewCommand::Kind::stop) throw FatalInputError({}, "No \"stop\" here");
            ++obeyed_;
            return {"{\"kind\":\"answer\"}", {}};
        })
    {
        const std::string url = server_.url();
        port_ = static_cast<unsigned short>(std::stoi(url.substr(url.rfind(':') + 1)));
        token_ = url.substr(url.find("?token=") + 7);
    }

    std::string get(const std::string& target, const std::string& more = {}) const
    {
        const Client client(port_);
        client.send("GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) + "\r\n" + more + "\r\n");
        return client.receive();
    }
    Client socket(const std::string& more = {}) const
    {
        Client client(port_);
        client.send("GET /live?token=" + token_ + " HTTP/1.1\r\nHost: here\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" + more + "\r\n");
        return client;
    }

    std::atomic<int> obeyed_ = 0;
    ViewServer server_;
    unsigned short port_ = 0;
    std::string token_;
};

}

TEST_F(ViewServerTest, ThePageNeedsTheToken)
{
    EXPECT_EQ(token_.size(), 32u);
    EXPECT_TRUE(get("/?token=" + token_).starts_with("HTTP/1.1 200"));
    for (const std::string query : {std::string(), std::string("?token="), "?token=" + token_.substr(1), "?token=" + token_ + "0", "?token=" + std::string(32, '0')})
    {
        EXPECT_TRUE(get("/" + query).starts_with("HTTP/1.1 403")) << query;
        EXPECT_TRUE(get("/live" + query).starts_with("HTTP/1.1 403")) << query;
    }
    EXPECT_TRUE(get("/../../etc/passwd?token=" + token_).starts_with("HTTP/1.1 404"));
}

TEST_F(ViewServerTest, OtherOriginsAreRefused)
{
    EXPECT_TRUE(get("/live?token=" + token_, "Origin: http://evil.example\r\n").starts_with("HTTP/1.1 403"));
    EXPECT_TRUE(socket("Origin: http://evil.example\r\n").receive().starts_with("HTTP/1.1 403"));
    EXPECT_TRUE(socket("Origin: http://here\r\n").receive("\r\n\r\n").starts_with("HTTP/1.1 101"));
}

TEST_F(ViewServerTest, CommandsComeAndAnswersGo)
{
    server_.keep("scene", "{\"kind\":\"scene\"}");
    const Client client = socket();
    client.receive("scene");
    client.send(textFrame("pause"));
    EXPECT_NE(client.receive("answer").find("answer"), std::string::npos);
    EXPECT_EQ(obeyed_, 1);
    client.send(textFrame("stop"));             // whose error is told, as JSON
    EXPECT_NE(client.receive("here").find("No \\\"stop\\\""), std::string::npos);
    client.send(textFrame("rm -rf /"));
    EXPECT_NE(client.receive("unknown word").find("unknown word"), std::string::npos);
    EXPECT_EQ(obeyed_, 1);
}

TEST_F(ViewServerTest, AFrameGoesToWhoAsksForOne)
{
    const Client client = socket();
    client.receive("\r\n\r\n");
    EXPECT_EQ(server_.wanted(), 0u);
    client.send(textFrame("next 1234"));
    ASSERT_TRUE(comesTrue([&] { return server_.wanted() == 1234; }));
    server_.publish([] { return std::string("first frame"); });
    EXPECT_NE(client.receive("first frame").find("first frame"), std::string::npos);
    EXPECT_EQ(server_.wanted(), 0u);
    server_.publish([] { return std::string("never sent"); });              // nobody waits
    server_.publish([] { return std::string("newest frame"); });
    client.send(textFrame("next 1"));
    const std::string got = client.receive("newest frame");
    EXPECT_NE(got.find("newest frame"), std::string::npos);
    EXPECT_EQ(got.find("never sent"), std::string::npos);
}

TEST_F(ViewServerTest, BrokenAndOversizedMessagesEndTheirConnectionAlone)
{
    const Client good = socket();
    good.receive("\r\n\r\n");
    for (const std::string& bytes :
        {textFrame(std::string(1000, 'a')), std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10) + std::string(64, 'x'), std::string(200, '\xff'),
            std::string("\x81\x05hello", 7), std::string("\x8f\x80\0\0\0\0", 6)})
    {
        const Client bad = socket();
        bad.receive("\r\n\r\n");
        bad.send(bytes);
        bad.receive();                          // up to the end
    }
    EXPECT_TRUE(comesTrue([&] { return server_.clients() == 1; }));
    const Client noHttp(port_);
    noHttp.send(std::string(20000, '\x01'));
    noHttp.receive();
    good.send(textFrame("pause"));
    EXPECT_NE(good.receive("answer").find("answer"), std::string::npos);
    EXPECT_EQ(obeyed_, 1);
}

TEST_F(ViewServerTest, OfAHundredClientsSomeAreServedAndNoneIsHarmful)
{
    std::vector<Client> crowd;
    for (int i = 0; i < 100; ++i) crowd.push_back(socket());
    EXPECT_TRUE(comesTrue([&] { return server_.clients() == 32; }));
    crowd.clear();
    EXPECT_TRUE(comesTrue([&] { return server_.clients() == 0; }));
    EXPECT_TRUE(get("/?token=" + token_).starts_with("HTTP/1.1 200"));
}

TEST_F(ViewServerTest, AClientThatReadsNothingIsDroppedAndHoldsNobodyUp)
{
    const Client deaf = socket();
    ASSERT_TRUE(comesTrue([&] { return server_.clients() == 1; }));
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 200; ++i) server_.keep("scene", std::string(1'000'000, 'x'));
    // The calls return at once: copies of 200 MB alone take below a second, a client's patience would be 30.
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5);
    EXPECT_TRUE(comesTrue([&] { return server_.clients() == 0; }));
}

TEST(ViewAddress, PortsAndAddressesAreTaken)
{
    EXPECT_EQ(ViewAddress::parse("8090").port, 8090);
    EXPECT_EQ(ViewAddress::parse("8090").host, "127.0.0.1");
    EXPECT_EQ(ViewAddress::parse("0.0.0.0:80").host, "0.0.0.0");
    for (const char* const text : {"", "x", "65536", "-1", "example.org:80", "1.2.3.4:"}) EXPECT_THROW(ViewAddress::parse(text), FatalInputError) << text;
}

TEST(ViewAddress, ATakenPortIsRefusedWhereItWasAskedFor)
{
    const auto nothing = [](const ViewCommand&) { return ViewServer::Answer(); };
    const ViewServer first({}, nothing);
    const std::string url = first.url();
    const auto port = static_cast<unsigned short>(std::stoi(url.substr(url.rfind(':') + 1)));
    EXPECT_THROW(ViewServer({"127.0.0.1", port, true}, nothing), FatalError);
    EXPECT_NO_THROW(ViewServer({"127.0.0.1", port, false}, nothing));
}
