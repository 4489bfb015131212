// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tamias2d::verify {

/// What an experiment reads off each engine.
struct Quantity {
    std::string name;
    std::string unit;
    std::optional<double> reference;  ///< closed form, or what an ideal body would do
    /// What a difference of 100 % means; none: the size of the reference. 0: differences are not
    /// given in percent.
    std::optional<double> scale = std::nullopt;
};

/// One value for each Quantity; none where an engine cannot do it.
using Values = std::vector<std::optional<double>>;

/// Collects the rows of the report as JSON.
class Report {
public:
    /// Starts a group of rows. `text` says what is compared and with which settings.
    void group(const std::string& title, const std::string& text);

    /// Runs one experiment with every engine, and adds one row for each quantity.
    void measure(const std::string& experiment, const std::vector<Quantity>& quantities,
                 const std::function<Values(const EngineKind&)>& run);

    /// A scene for Pymunk to run as well: the same bodies, and what Chipmunk makes of them after 1, 10
    /// and 60 s.
    void shareScene(const std::string& title, const EngineKind& chipmunk, const Scene& scene);

    const nlohmann::json& json() const { return json_; }
    nlohmann::json& json() { return json_; }

private:
    nlohmann::json json_;
};

}  // namespace tamias2d::verify
