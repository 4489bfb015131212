// SPDX-License-Identifier: MIT
#pragma once

#include "base/id_pool.hpp"
#include "base/shared_table.hpp"
#include "geometry/solid.hpp"
#include "model/bodies.hpp"
#include "narrowphase/convex.hpp"

#include <tamias2d/model/defs.hpp>

#include <limits>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A geometry at its place in a body: shared by all shapes of which it is the same to the bit.
struct ShapeForm {
    Geometry geometry;   // as given
    Vec2 offset;         // as given   [m]
    double angle = 0;    // as given   [rad]
    Vec2 center;         // of mass, in the body's frame   [m]
    Convex convex;       // about that center
    Solid solid;         // of the geometry, in its own frame
};

/// What a shape is made of and what it meets; shared likewise.
struct ShapeSurface {
    real density = 1;    // [kg/m^2]
    Material material;
    Filter filter;
};

/// What the world remembers of a shape itself.
struct ShapeRow {
    std::uint32_t body = 0;   // slot
    std::uint32_t next = 0, previous = 0;   // slots, in the ring of its body's shapes
    std::uint32_t form = SharedTable<ShapeForm>::kNone;
    std::uint32_t surface = SharedTable<ShapeSurface>::kNone;
    std::uint64_t userData = 0;
};

/// The shapes of a world; a row is the slot of the shape's id.
struct ShapeTable {
    explicit ShapeTable(std::uint32_t world, MemorySource memory = nullptr)
        : ids(world, memory), rows(sourceOr(memory)), forms(memory), surfaces(memory)
    {
    }

    IdPool<ShapeId> ids;
    Column<ShapeRow> rows;
    SharedTable<ShapeForm> forms;
    SharedTable<ShapeSurface> surfaces;

    /// Is it that of the shape made last? Who makes many of a kind need not have each one checked.
    bool isLastGeometry(const Geometry& geometry) const;
    const ShapeForm& form(std::uint32_t slot) const { return forms[rows[slot].form]; }
    const Convex& convex(std::uint32_t slot) const { return form(slot).convex; }
    const ShapeSurface& surface(std::uint32_t slot) const { return surfaces[rows[slot].surface]; }
    const Material& material(std::uint32_t slot) const { return surface(slot).material; }
    const Filter& filter(std::uint32_t slot) const { return surface(slot).filter; }
    ShapeDef def(std::uint32_t slot) const;   ///< as given

    /// Makes the shape one of such a form about its body's center of mass.
    void setForm(std::uint32_t slot, const Geometry& geometry, Vec2 offset, double angle, Vec2 center);
    void setSurface(std::uint32_t slot, const ShapeSurface& surface);

    /// Puts the shape at the end of the list, or takes it out.
    void link(ShapeList& list, std::uint32_t slot);
    void unlink(ShapeList& list, std::uint32_t slot);
    /// As no shape: what it shared is left to others.
    void clear(std::uint32_t slot);

    /// Slots of the shapes of a list, in order.
    class Range {
    public:
        struct Iterator {
            const Column<ShapeRow>* rows;
            std::uint32_t slot, left;

            std::uint32_t operator*() const { return slot; }
            Iterator& operator++()
            {
                slot = (*rows)[slot].next;
                --left;
                return *this;
            }
            bool operator!=(const Iterator& other) const { return left != other.left; }
        };
        Range(const Column<ShapeRow>& rows, const ShapeList& list) : rows_(&rows), list_(list) {}
        Iterator begin() const { return {rows_, list_.first, list_.count}; }
        Iterator end() const { return {rows_, list_.first, 0}; }

    private:
        const Column<ShapeRow>* rows_;
        ShapeList list_;
    };
    Range of(const ShapeList& list) const { return {rows, list}; }
    Range of(const BodyRow& body) const { return {rows, body.shapes}; }
    /// Of the smallest shape of the body; the greatest number if it has none.   [m]
    real widthOf(const BodyRow& body) const
    {
        real width = std::numeric_limits<real>::max();
        for (const std::uint32_t slot : of(body)) width = minimum(width, convex(slot).size);
        return width;
    }
    std::uint32_t lastOf(const ShapeList& list) const { return rows[list.first].previous; }
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
