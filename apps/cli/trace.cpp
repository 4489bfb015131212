// SPDX-License-Identifier: MIT
#include "trace.hpp"

#include <fmt/format.h>

#include <iterator>

namespace tamias2d::cli::TAMIAS_PRECISION {

namespace {

/// A cell that no comma, quote or line break can leave.
std::string cell(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

void appendConserved(fmt::memory_buffer& row, const Energy& energy, const Momentum& momentum)
{
    fmt::format_to(std::back_inserter(row), "{},{},{},{},{}\n", energy.kinetic(), energy.potential,
                   momentum.linear.x, momentum.linear.y, momentum.angular);
}

}  // namespace

Trace::Trace(OutputFile& file, World& world) : out_(&file.stream())
{
    *out_ << "time,body,name,x,y,angle,vx,vy,w,kinetic,potential,px,py,L\n";
    for (const BodyId id : world.bodies()) {
        const Body body = world.body(id);
        if (body.type() == BodyType::Static) continue;
        bodies_.push_back(id);
        names_.push_back(cell(body.name()));
    }
    add(world);
}

void Trace::add(World& world)
{
    fmt::memory_buffer rows;
    const double time = world.time();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body body = world.body(bodies_[i]);
        const Position p = body.position();
        const Vec2 v = body.linearVelocity();
        fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{},{},", time, bodies_[i].index,
                       names_[i], p.x, p.y, body.angle(), v.x, v.y, body.angularVelocity());
        appendConserved(rows, body.energy(), body.momentum());
    }
    fmt::format_to(std::back_inserter(rows), "{},*,,,,,,,,", time);
    appendConserved(rows, world.energy(), world.momentum());
    out_->write(rows.data(), static_cast<std::streamsize>(rows.size()));
}

}  // namespace tamias2d::cli::TAMIAS_PRECISION
