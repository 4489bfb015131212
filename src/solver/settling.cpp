// SPDX-License-Identifier: MIT
#include "solver/settling.hpp"

#include "solver/body_mass.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void SettlingIslands::add(const Motion& m, BodyMotion<real> motion, Large& island) const
{
    const DVec2 v = toDVec2(motion.velocity);
    const double mass = massOf(m), spin = static_cast<double>(motion.spin);
    island.mass += mass;
    island.momentum += mass * v;
    island.energy += mass * dot(v, v);
    island.energy += inertiaOf(m) * spin * spin;
}

void SettlingIslands::find(const Islands& islands, const Table<Motion>& rows,
                           const Table<LaneRow>& velocities, real slow)
{
    largeOf_.assign(islands.count(), Islands::kNone);
    large_.clear();
    for (std::uint32_t island = 0; island < islands.count(); ++island) {
        if (islands.sizeOf[island] < kLarge) continue;
        largeOf_[island] = static_cast<std::uint32_t>(large_.size());
        large_.push_back({island});
    }
    for (std::size_t i = 0; i < islands.islandOf.size() && !large_.empty(); ++i) {
        const std::uint32_t island = islands.islandOf[i];
        if (island == Islands::kNone || largeOf_[island] == Islands::kNone) continue;
        const Motion& m = rows[i];
        if (!(m.greatestInvMass() > 0)) continue;
        BodyMotion<real> motion = velocityOf(velocities[i]);
        const std::uint32_t ground = islands.groundOf[island];
        if (ground < Islands::kSeveral) {
            const BodyMotion<real> of = velocityOf(velocities[ground]);
            motion.velocity -= of.velocity + cross(of.spin, toVec2(m.center - rows[ground].center));
            motion.spin -= of.spin;
        }
        add(m, motion, large_[largeOf_[island]]);
    }
    const double most = static_cast<double>(slow) * static_cast<double>(slow);
    for (Large& of : large_) {
        const bool floats = islands.groundOf[of.island] == Islands::kNone && of.mass > 0;
        const double ofWhole = floats ? dot(of.momentum, of.momentum) / of.mass : 0;
        of.settles = of.energy - ofWhole < most * of.mass;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
