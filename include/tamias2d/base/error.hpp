// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <exception>
#include <string>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Says which input was refused and why [R4]. Nothing has changed when it is raised.
///
/// `what()` reads "BodyDef.mass = -1: must be finite and > 0 kg".
class InputError : public std::exception {
public:
    InputError(std::string fieldName, std::string givenValue, std::string brokenRule);

    std::string field;  ///< what was given, e.g. "ShapeDef.material.restitution"
    std::string value;  ///< as given, e.g. "1.1"
    std::string rule;   ///< what must hold, e.g. "must be in [0, 1]"

    const char* what() const noexcept override { return text_.c_str(); }

private:
    std::string text_;
};

/// Receives the error when the library is built without exceptions. The refused call then does
/// nothing and returns a null handle or a zero value.
using ErrorHandler = void (*)(const InputError&);

/// Installs the handler and returns the one before it. Null means: errors pass silently.
ErrorHandler setErrorHandler(ErrorHandler handler) noexcept;

/// Raises `error`: throws it, or hands it to the error handler in a build without exceptions.
void fail(const InputError& error);

}  // namespace tamias2d::inline TAMIAS_PRECISION
