// SPDX-License-Identifier: MIT
#pragma once

#include "support/script_operations.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace tamias2d::test {

/// A random script: within four walls anything is created, destroyed, moved, changed and stepped, in any
/// order. Each thing that can be done is a line of operations(): what comes to the library gets a line there,
/// and is then part of every test by scripts.
class RandomScript : public ScriptOperations {
public:
    explicit RandomScript(std::uint32_t seed, const WorldDef& def = {}) : ScriptOperations(seed, def)
    {
        for (const Operation& operation : operations()) weights_ += operation.weight;
    }
    virtual ~RandomScript() = default;
    RandomScript(RandomScript&&) = delete;

    /// Runs on until something fails.
    void run(int count)
    {
        for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
            const Operation& operation = choose();
            SCOPED_TRACE("operation " + std::to_string(i) + ": " + operation.name);
            (this->*operation.act)();
            afterEach();
        }
    }

    World& world() { return world_; }
    int steps() const { return steps_; }

protected:
    virtual void afterEach() {}

private:
    struct Operation {
        const char* name;
        int weight;  // how often, against the others
        void (RandomScript::*act)();
    };

    static const std::vector<Operation>& operations()
    {
        using S = RandomScript;
        static const std::vector<Operation> all = {
            {"step", 24, &S::step},
            {"create a body", 6, &S::createBody},
            {"destroy a body", 3, &S::destroyBody},
            {"create a shape", 2, &S::createShape},
            {"destroy a shape", 2, &S::destroyShape},
            {"redefine a shape", 2, &S::redefineShape},
            {"set material", 1, &S::setMaterial},
            {"set filter", 2, &S::setFilter},
            {"set density", 1, &S::setDensity},
            {"move a body", 2, &S::moveBody},
            {"move many bodies", 1, &S::moveMany},
            {"set velocity", 2, &S::setVelocity},
            {"set type", 2, &S::setType},
            {"set mass", 2, &S::setMass},
            {"enable or disable", 2, &S::setEnabled},
            {"set locks", 2, &S::setLocks},
            {"set damping", 1, &S::setDamping},
            {"wake", 1, &S::wake},
            {"put to sleep", 3, &S::putToSleep},
            {"allow sleep", 1, &S::allowSleep},
            {"push", 2, &S::push},
            {"push on", 2, &S::pushOn},
            {"set gravity", 2, &S::setGravity},
            {"add or remove a force law", 1, &S::changeLaws},
            {"create a joint", 5, &S::createJoint},
            {"destroy a joint", 2, &S::destroyJoint},
            {"give a joint another kind", 2, &S::setKind},
            {"change a joint", 2, &S::changeJoint},
        };
        return all;
    }

    const Operation& choose()
    {
        int left = below(weights_);
        for (const Operation& operation : operations())
            if ((left -= operation.weight) < 0) return operation;
        return operations().front();
    }

    int weights_ = 0;
};

}  // namespace tamias2d::test
