// SPDX-License-Identifier: MIT
// What every call of Body begins with: from the handle to its row.
#pragma once

#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

inline BodyRow& deadBodyRow()
{
    static thread_local BodyRow row;
    return row = {};
}

inline const BodyTable& noBodies()
{
    static const BodyTable none(0);
    return none;
}

// The row, or a fresh one that nobody keeps when a dead handle was let pass by the error handler.
#define TAMIAS_BODY_ROW(name)                                                                                \
    World* const w = alive();                                                                                \
    if (w) w->impl_->settleMass(id_.index);                                                                  \
    [[maybe_unused]] const BodyTable& table = w ? w->impl_->bodies : noBodies();                             \
    BodyRow& name = w ? w->impl_->row(id_) : deadBodyRow()

}  // namespace tamias2d::inline TAMIAS_PRECISION
