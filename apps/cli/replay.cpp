// SPDX-License-Identifier: MIT
#include "replay.hpp"

#include "replay_page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace tamias2d::cli::TAMIAS_PRECISION {

namespace {

constexpr std::int64_t kMostFrames = 1500;
constexpr std::size_t kMostBytes = 18'000'000;  // of frames; the page stays below 20 MB
constexpr std::size_t kMostHits = 40;            // of one step
constexpr std::string_view kPlace = "/*TAMIAS_REPLAY_DATA*/";

using Json = nlohmann::ordered_json;

/// With so many decimals and no trailing zeros; what is no number is null.
void appendFixed(std::string& out, double value, int decimals)
{
    if (!std::isfinite(value)) {
        out += "null";
        return;
    }
    const std::size_t start = out.size();
    fmt::format_to(std::back_inserter(out), "{:.{}f}", value, decimals);
    if (decimals > 0) out.erase(out.find_last_not_of('0') + 1);
    if (out.back() == '.') out.pop_back();
    if (out.compare(start, std::string::npos, "-0") == 0) out.replace(start, 2, "0");
}

/// With so many significant digits.
void appendShort(std::string& out, double value, int digits)
{
    if (std::isfinite(value))
        fmt::format_to(std::back_inserter(out), "{:.{}g}", value, digits);
    else
        out += "null";
}

/// "[x,y,nx,ny,impulse]," of an impulse at a point.
void appendImpulse(std::string& out, Position at, Vec2 normal, real impulse, int decimals)
{
    out += '[';
    appendFixed(out, at.x, decimals);
    out += ',';
    appendFixed(out, at.y, decimals);
    out += ',';
    appendFixed(out, static_cast<double>(normal.x), 3);
    out += ',';
    appendFixed(out, static_cast<double>(normal.y), 3);
    out += ',';
    appendShort(out, static_cast<double>(impulse), 3);
    out += "],";
}

void dropComma(std::string& out)
{
    if (!out.empty() && out.back() == ',') out.pop_back();
}

struct ShapeOutline {
    const char* kind;
    std::vector<Vec2> points;
    real radius;
};

struct OutlineOf {
    ShapeOutline operator()(const Circle& s) const { return {"circle", {s.center}, s.radius}; }
    ShapeOutline operator()(const Capsule& s) const { return {"capsule", {s.a, s.b}, s.radius}; }
    ShapeOutline operator()(const Segment& s) const { return {"segment", {s.a, s.b}, s.radius}; }
    ShapeOutline operator()(const Polygon& s) const
    {
        return {"polygon", {s.points().begin(), s.points().end()}, s.radius};
    }
};

/// The shape in its body's frame.
Json shapeJson(const ShapeDef& def)
{
    const ShapeOutline outline = std::visit(OutlineOf{}, def.geometry);
    const Rot turn = Rot::ofAngle(def.angle);
    Json points = Json::array();
    for (const Vec2 point : outline.points) {
        const Vec2 placed = def.offset + rotate(turn, point);
        points.push_back({placed.x, placed.y});
    }
    return {{"kind", outline.kind}, {"points", points}, {"radius", outline.radius}};
}

const char* typeName(BodyType type)
{
    switch (type) {
    case BodyType::Static:
        return "static";
    case BodyType::Kinematic:
        return "kinematic";
    case BodyType::Dynamic:
        break;
    }
    return "dynamic";
}

Json bodyJson(const Body& body)
{
    Json shapes = Json::array();
    for (const Shape& shape : body.shapes()) shapes.push_back(shapeJson(shape.definition()));
    return {{"name", body.name()}, {"type", typeName(body.type())}, {"shapes", shapes}};
}

/// How a joint is drawn: a line through points, each in the frame of a body, or, with body -1, in the world.
struct JointLine {
    std::int64_t bodyA, bodyB;
    Json line = Json::array(), dots = Json::array();
    bool isDashed = false;

    Json onA(Vec2 p) const { return {bodyA, p.x, p.y}; }
    Json onB(Vec2 p) const { return {bodyB, p.x, p.y}; }
    static Json inWorld(Position p) { return {-1, p.x, p.y}; }

    template <class Kind>
    void operator()(const Kind& k)
    {
        // Those that hold angles only, or nothing, have no place to be drawn at.
        if constexpr (requires { k.anchorA; }) line = dots = {onA(k.anchorA), onB(k.anchorB)};
    }
    void operator()(const GrooveJoint& k)
    {
        line = {onA(k.start), onA(k.end)};
        dots = {onB(k.anchorB)};
    }
    void operator()(const PulleyJoint& k)
    {
        line = dots = {onA(k.anchorA), inWorld(k.wheelA), inWorld(k.wheelB), onB(k.anchorB)};
    }
    void operator()(const TargetJoint& k) { line = dots = {inWorld(k.target), onB(k.anchor)}; }
    void operator()(const GearJoint&)
    {
        line = {onA({}), onB({})};
        isDashed = true;
    }
};

Json jointJson(const Joint& joint, const std::vector<BodyId>& bodies)
{
    const auto placeOf = [&](BodyId body) {
        return std::lower_bound(bodies.begin(), bodies.end(), body) - bodies.begin();
    };
    JointLine drawn{placeOf(joint.bodyA()), placeOf(joint.bodyB())};
    std::visit(drawn, joint.kind());
    if (!joint.isEnabled()) drawn.line = drawn.dots = Json::array();
    return {{"line", drawn.line}, {"dots", drawn.dots}, {"dashed", drawn.isDashed}};
}

/// The text of JSON for inside a <script>: a name such as "</script>" must not end it.
std::string scriptText(const Json& value)
{
    std::string out;
    for (const char c : value.dump(-1, ' ', false, Json::error_handler_t::replace)) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

Json headJson(const Scene& scene, const ReplayTiming& timing)
{
    Json head = {{"title", scene.info.title.empty() ? "A scene" : scene.info.title},
                 {"precision", std::numeric_limits<real>::digits > 24 ? "f64" : "f32"},
                 {"rate", timing.rate},
                 {"substeps", timing.substeps},
                 {"version", TAMIAS_VERSION}};
    if (const auto& view = scene.info.view) {
        head["view"] = {{"lower", {view->lower.x, view->lower.y}}, {"upper", {view->upper.x, view->upper.y}}};
    }
    head["bodies"] = Json::array();
    for (const BodyId id : scene.world->bodies()) head["bodies"].push_back(bodyJson(scene.world->body(id)));
    const std::vector<BodyId> bodies = scene.world->bodies();
    head["joints"] = Json::array();
    for (const JointId id : scene.world->joints())
        head["joints"].push_back(jointJson(scene.world->joint(id), bodies));
    return head;
}

}  // namespace

Replay::Replay(const Scene& scene, const ReplayTiming& timing)
    : timing_(timing), bodies_(scene.world->bodies()), joints_(scene.world->joints()), states_(bodies_.size())
{
    head_ = scriptText(headJson(scene, timing));
    head_.pop_back();  // its closing brace comes after the frames
    stride_ = std::max<std::int64_t>(1, (timing.steps + kMostFrames - 1) / kMostFrames);
    const double unit = static_cast<double>(scene.world->definition().lengthUnit);
    decimals_ = std::clamp(5 - static_cast<int>(std::lround(std::log10(unit))), 1, 15);
    addFrame(*scene.world);
}

void Replay::add(const World& world)
{
    ++step_;
    noteHits(world);
    for (const BreakEvent& event : world.events().breaks) {
        const auto place = std::lower_bound(joints_.begin(), joints_.end(), event.joint) - joints_.begin();
        fmt::format_to(std::back_inserter(breaks_), "[{},", place);
        appendShort(breaks_, world.time(), 9);
        breaks_ += "],";
    }
    if (step_ % stride_ == 0) addFrame(world);
    if (bytes_ > kMostBytes) thinOut();
}

/// The strongest of the step; a crowd that comes to rest makes hundreds that nobody could see.
void Replay::noteHits(const World& world)
{
    std::vector<HitEvent> hits(world.events().hits.begin(), world.events().hits.end());
    const auto isStronger = [](const HitEvent& a, const HitEvent& b) {
        return a.normalImpulse > b.normalImpulse;
    };
    std::stable_sort(hits.begin(), hits.end(), isStronger);
    hits.resize(std::min(hits.size(), kMostHits));
    for (const HitEvent& hit : hits) {
        appendImpulse(hits_, hit.point, hit.normal, hit.normalImpulse, decimals_ - 1);
    }
}

void Replay::addFrame(const World& world)
{
    std::string out = "{\"t\":";
    appendShort(out, world.time(), 9);

    world.readStates(bodies_, states_);
    out += ",\"poses\":[";
    for (const BodyState& s : states_) {
        appendFixed(out, s.position.x, decimals_);
        out += ',';
        appendFixed(out, s.position.y, decimals_);
        out += ',';
        appendFixed(out, s.angle, 5);
        out += ',';
    }
    dropComma(out);
    out += "],\"velocities\":[";
    for (const BodyState& s : states_) {
        // Fixed decimals, so that the many bodies at rest take a digit each.
        appendFixed(out, static_cast<double>(s.linearVelocity.x), decimals_ - 1);
        out += ',';
        appendFixed(out, static_cast<double>(s.linearVelocity.y), decimals_ - 1);
        out += ',';
        appendFixed(out, static_cast<double>(s.angularVelocity), 4);
        out += ',';
    }
    dropComma(out);
    out += "],\"contacts\":[";
    for (const ContactView& contact : world.contacts()) {
        for (int i = 0; contact.touching && i < contact.pointCount; ++i) {
            const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
            appendImpulse(out, point.position, contact.normal, point.normalImpulse, decimals_ - 1);
        }
    }
    dropComma(out);

    const Energy energy = world.energy();
    const Momentum momentum = world.momentum();
    out += "],\"energy\":[";
    for (const double e : {energy.kinetic(), energy.potential, energy.total()}) {
        appendShort(out, e, 9);
        out += ',';
    }
    dropComma(out);
    out += "],\"momentum\":[";
    for (const double p : {momentum.linear.x, momentum.linear.y, momentum.angular}) {
        appendShort(out, p, 6);
        out += ',';
    }
    dropComma(out);
    out += ']';

    bytes_ += out.size() + hits_.size();
    frames_.push_back({std::move(out), std::move(hits_)});
    hits_.clear();
    framedStep_ = step_;
}

/// Leaves out every second frame; the hits of those go to the frame after.
void Replay::thinOut()
{
    std::vector<Frame> kept;
    std::string carried;
    bytes_ = 0;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        carried += frames_[i].hits;
        if (i % 2 == 1) continue;
        bytes_ += frames_[i].state.size() + carried.size();
        kept.push_back({std::move(frames_[i].state), std::move(carried)});
        carried.clear();
    }
    hits_ = carried + hits_;
    frames_ = std::move(kept);
    stride_ *= 2;
}

void Replay::write(OutputFile& file, const World& world)
{
    if (framedStep_ != step_) addFrame(world);
    std::ostream& out = file.stream();
    const std::string_view page = replayPage();
    const std::size_t place = page.find(kPlace);
    out << page.substr(0, place) << head_ << ",\"dt\":" << static_cast<double>(stride_) / timing_.rate
        << ",\"frames\":[";
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        dropComma(frames_[i].hits);
        out << (i == 0 ? "\n" : ",\n") << frames_[i].state << ",\"hits\":[" << frames_[i].hits << "]}";
    }
    dropComma(breaks_);
    out << "\n],\"breaks\":[" << breaks_ << "]}" << page.substr(place + kPlace.size());
}

}  // namespace tamias2d::cli::TAMIAS_PRECISION
