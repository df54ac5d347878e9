// A link over one Boost.Asio stream, plain or TLS: what a careful programmer writes without a middleware.
#pragma once

#include "measure/options.hpp"
#include "measure/transport.hpp"
#include "stream/stream_input.hpp"
#include "stream/stream_output.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace liena::compare {

/// `Stream` is a tcp::socket or a TLS stream over one. It is made when the connection stands.
template <typename Stream>
class AsioLink : public Transport {
public:
    using Error = boost::system::error_code;

    explicit AsioLink(const Options& options)
        : m_options(options), m_pixels(std::make_shared<const std::vector<std::byte>>(options.frameBytes))
    {}

    void every(Nanoseconds period, std::function<void()> task) override
    {
        m_tasks.push_back(std::make_unique<PeriodicTask>(m_io, period, std::move(task)));
    }

    void run(LinkEvents& events) override
    {
        m_events = &events;
        m_stream = secured(connected());
        for (auto& task : m_tasks)
            repeat(*task);
        events.ready();
        read();
        m_io.run();
    }

    void stop() override { m_io.stop(); }

    void sendCommand(const Command& command) override
    {
        m_output.append(command);
        write();
    }

    void sendFrame(const Stamp& stamp) override
    {
        boost::asio::post(m_io, [this, stamp] {
            m_output.append(stamp, m_pixels);
            write();
        });
    }

protected:
    using Socket = boost::asio::ip::tcp::socket;

    virtual std::unique_ptr<Stream> secured(Socket socket) = 0;
    bool isClient() const { return m_options.role == Role::Client; }

private:
    struct PeriodicTask {
        PeriodicTask(boost::asio::io_context& io, Nanoseconds each, std::function<void()> what)
            : timer(io), period(each), due(Clock::now()), task(std::move(what))
        {}
        boost::asio::steady_timer timer;
        Nanoseconds period;
        Instant due;
        std::function<void()> task;
    };

    Socket connected()
    {
        const boost::asio::ip::tcp::endpoint place(boost::asio::ip::make_address(m_options.host), m_options.port);
        Socket socket(m_io);
        if (isClient())
            for (Error error; socket.connect(place, error), error;) { // the echo may start later
                socket.close();
                boost::asio::steady_timer(m_io, std::chrono::milliseconds(20)).wait();
            }
        else
            boost::asio::ip::tcp::acceptor(m_io, place).accept(socket);
        socket.set_option(boost::asio::ip::tcp::no_delay(true));
        return socket;
    }

    void repeat(PeriodicTask& task)
    {
        task.due = std::max(task.due + task.period, Clock::now());
        task.timer.expires_at(task.due);
        task.timer.async_wait([this, &task](const Error& error) {
            if (error)
                return;
            repeat(task);
            task.task();
        });
    }

    void read()
    {
        const auto space = m_input.space();
        m_stream->async_read_some(boost::asio::buffer(space.data(), space.size()), [this](const Error& error, std::size_t count) {
            if (error)
                return m_io.stop();
            m_input.read(count, *m_events);
            read();
        });
    }

    void write()
    {
        if (!m_underWay.empty() || m_output.empty())
            return;
        m_underWay = m_output.take();
        std::vector<boost::asio::const_buffer> parts;
        for (const auto& chunk : m_underWay) {
            parts.emplace_back(chunk.bytes.data(), chunk.bytes.size());
            if (chunk.pixels)
                parts.emplace_back(chunk.pixels->data(), chunk.pixels->size());
        }
        boost::asio::async_write(*m_stream, parts, [this](const Error& error, std::size_t) {
            m_underWay.clear();
            if (error)
                return m_io.stop();
            write();
        });
    }

    Options m_options;
    StreamOutput::Pixels m_pixels;
    boost::asio::io_context m_io{1};
    std::unique_ptr<Stream> m_stream;
    std::vector<std::unique_ptr<PeriodicTask>> m_tasks;
    LinkEvents* m_events = nullptr;
    StreamInput m_input;
    StreamOutput m_output;
    std::vector<StreamOutput::Chunk> m_underWay;
};

} // namespace liena::compare
