// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>
#include <tamias2d/base/error.hpp>
#include <tamias2d/base/ids.hpp>
#include <tamias2d/base/profile.hpp>
#include <tamias2d/diagnostics/energy.hpp>
#include <tamias2d/forces/force_law.hpp>
#include <tamias2d/geometry/aabb.hpp>
#include <tamias2d/geometry/hull.hpp>
#include <tamias2d/geometry/mass.hpp>
#include <tamias2d/geometry/shapes.hpp>
#include <tamias2d/math/scalar.hpp>
#include <tamias2d/math/transform.hpp>
#include <tamias2d/math/vec2.hpp>
#include <tamias2d/model/clamps.hpp>
#include <tamias2d/model/defs.hpp>
#include <tamias2d/model/events.hpp>
#include <tamias2d/model/joint_defs.hpp>
#include <tamias2d/model/material.hpp>
#include <tamias2d/model/tuning.hpp>
#include <tamias2d/queries/queries.hpp>
#include <tamias2d/tasks/task_system.hpp>
#include <tamias2d/world/fixed_stepper.hpp>
#include <tamias2d/world/joint.hpp>
#include <tamias2d/world/report.hpp>
#include <tamias2d/world/world.hpp>
