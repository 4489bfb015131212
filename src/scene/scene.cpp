// SPDX-License-Identifier: MIT
#include <tamias2d/scene/scene.hpp>

#include <utility>

namespace tamias2d::inline TAMIAS_PRECISION {

SceneError::SceneError(std::string sourceName, int lineNumber, int columnNumber, std::string path,
                       std::string givenValue, std::string brokenRule)
    : InputError(std::move(path), std::move(givenValue), std::move(brokenRule)),
      source(std::move(sourceName)), line(lineNumber), column(columnNumber)
{
    // Faults of the text itself have no path: there the column leads to the place.
    sceneText_ = source;
    if (line > 0) sceneText_ += ":" + std::to_string(line);
    if (field.empty() && column > 0) sceneText_ += ":" + std::to_string(column);
    sceneText_ += ": ";
    if (!field.empty()) {
        sceneText_ += field;
        if (!value.empty()) sceneText_ += " = " + value;
        sceneText_ += ": ";
    }
    sceneText_ += rule;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
