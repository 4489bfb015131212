// SPDX-License-Identifier: MIT
#include <tamias2d/base/error.hpp>

#include <atomic>
#include <utility>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Worlds on different threads share it, hence atomic.
std::atomic<ErrorHandler> currentHandler{nullptr};

}  // namespace

InputError::InputError(std::string fieldName, std::string givenValue, std::string brokenRule)
    : field(std::move(fieldName)), value(std::move(givenValue)), rule(std::move(brokenRule)),
      text_(field + " = " + value + ": " + rule)
{
}

ErrorHandler setErrorHandler(ErrorHandler handler) noexcept
{
    return currentHandler.exchange(handler);
}

void fail(const InputError& error)
{
#if TAMIAS_HAS_EXCEPTIONS
    // A copy of its texts can run out of memory; std::bad_alloc is then what is thrown.
    throw error;  // NOLINT(bugprone-exception-copy-constructor-throws)
#else
    if (const ErrorHandler handler = currentHandler.load()) handler(error);
#endif
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
