// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <ostream>
#include <set>
#include <string>

namespace tamias2d::apps {

/// Writes World::profile() of many steps as JSON in the trace event format of Chrome, which chrome://tracing
/// and ui.perfetto.dev open: one complete event ("X") a span, times in microseconds to the nanosecond.
class ProfileJson {
public:
    explicit ProfileJson(std::ostream& out) : out_(out)
    {
        out_ << R"({"displayTimeUnit":"ms","traceEvents":[)";
        event(R"("name":"process_name","ph":"M","pid":1,"tid":0,"args":{"name":"Tamias2D"})");
    }

    /// The spans of one step; those of further steps come later.
    template <class Spans>
    void add(const Spans& spans, std::int64_t step)
    {
        for (const auto& span : spans) {
            const std::int64_t begin = nanoseconds(span.begin), end = nanoseconds(span.end);
            const std::string thread = std::to_string(span.thread);
            if (threads_.insert(span.thread).second)
                event(R"("name":"thread_name","ph":"M","pid":1,"tid":)" + thread +
                      R"(,"args":{"name":"thread )" + thread + R"("})");
            event(R"("name":")" + std::string(span.name) + R"(","cat":"step","ph":"X","ts":)" +
                  microseconds(begin) + R"(,"dur":)" + microseconds(end - begin) + R"(,"pid":1,"tid":)" +
                  thread + R"(,"args":{"step":)" + std::to_string(step) + "}");
        }
    }

    void finish() { out_ << "\n]}\n"; }

private:
    // Rounded alike, so that what nests still nests.
    static std::int64_t nanoseconds(double us) { return std::llround(1000 * us); }
    static std::string microseconds(std::int64_t ns)
    {
        std::string fraction = std::to_string(ns % 1000);
        fraction.insert(0, 3 - fraction.size(), '0');
        return std::to_string(ns / 1000) + '.' + fraction;
    }
    void event(const std::string& members)
    {
        out_ << (first_ ? "\n{" : ",\n{") << members << '}';
        first_ = false;
    }

    std::ostream& out_;
    std::set<std::uint32_t> threads_;
    bool first_ = true;
};

}  // namespace tamias2d::apps
