// SPDX-License-Identifier: MIT
#pragma once

#include "diagnostics/faults.hpp"
#include "model/bodies.hpp"
#include "model/contacts.hpp"
#include "model/joints.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"
#include "model/sleep.hpp"

#include <tamias2d/model/events.hpp>

#include <span>

namespace tamias2d::inline TAMIAS_PRECISION {

// What must hold of each table between steps, whatever was done to the world. Each function looks at one
// table and at those it points into; a table that is added gets one here and a call in World::validate.

/// Slots, free slots and generations of a table of ids, and that there is a row for each slot.
template <class IdType>
void validateIds(const IdPool<IdType>& ids, std::string_view table, std::size_t rows, Faults& faults)
{
    faults.at(table, 0);
    faults.that(rows == ids.slots(), "rows", rows, "must be as many as there are slots");
    const char* wrong = ids.fault();
    faults.that(wrong == nullptr, "ids", ids.alive(), wrong == nullptr ? "" : wrong);
}

/// Poses and motions are numbers within their bounds, and the shapes of each body are its own.
void validateBodies(const BodyTable& bodies, const ShapeTable& shapes, real lengthUnit, Faults& faults);

/// Each live shape belongs to one body, is what its definition says, and is convex.
void validateShapes(const ShapeTable& shapes, const BodyTable& bodies, Faults& faults);

/// Each pair once, of live shapes of two bodies, sorted unless contacts have come since the last step;
/// normals of length 1, impulses that push and stay within Coulomb's cone.
void validateContacts(std::span<const Contact> contacts, bool sorted, const ShapeTable& shapes,
                      Faults& faults);

/// Each live joint ties two live bodies, which know it; what it carries and counts are numbers.
void validateJoints(const JointTable& joints, const BodyTable& bodies, Faults& faults);

/// Bodies of a sleeping group know it, and are still; what touches them sleeps with them or cannot move.
void validateSleep(const SleepTable& asleep, const BodyTable& bodies, const ShapeTable& shapes,
                   Faults& faults);

/// The order of solving has each contact once, and no two of one color share a body that moves. Only as the
/// step left them: `motions` and the contacts' rows in it are of the last step.
void validateOrder(const ContactTable& contacts, const MotionTable& motions, Faults& faults);

/// Sorted, and numbers.
void validateEvents(const StepEvents& events, Faults& faults);

}  // namespace tamias2d::inline TAMIAS_PRECISION
