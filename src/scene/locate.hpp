// SPDX-License-Identifier: MIT
// From a path inside a JSON text back to the place in the text. Parsed values do not know where
// they came from; since only errors ask, finding the place again costs nothing in a good scene.
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

struct TextPlace {
    int line = 1;    ///< from 1
    int column = 1;  ///< from 1, in bytes
};

/// The place of a byte of the text.
TextPlace placeOf(std::string_view text, std::size_t offset) noexcept;

/// Where the value named by a JSON pointer starts: its key, if it has one. Of a key that is there
/// twice it is the last. If the path leads nowhere, where its last existing part starts.
/// `text` must be valid JSON.
std::size_t findInText(std::string_view text, std::string_view pointer);

/// One part of a JSON pointer, with ~ and / escaped.
std::string escapePointer(std::string_view part);

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
