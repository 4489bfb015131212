// SPDX-License-Identifier: MIT
// Joints of your own. You write a struct that measures rows: what it asks of the places and the angles of its
// bodies. The solver asks it where the bodies are and where they are expected to be, and answers the rows as
// it answers those of the built-in kinds. docs/guide/own-joints.md
#pragma once

#include <tamias2d/math/transform.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION {

/// No bound: of a force, a length or a threshold. So much of anything is as good as without end.
inline constexpr real kUnlimited = real(1e30);

/// What a row of a joint asks for, with C its error.
enum class RowKind : std::uint8_t {
    Rigid,  ///< C = 0
    Spring,  ///< a force of -stiffness * C - damping * its rate
    Motor,  ///< a speed, with no more than a force
    Limit,  ///< C >= 0
};

/// One body as a constraint sees it: where it is, or is expected to be.
struct ConstraintBody {
    Position center = {};  ///< of mass                                             [m]
    double angle = 0;  ///< of the body, turns counted                               [rad]
    double turned = 0;  ///< since the joint was made, turns counted                 [rad]
    Rot rotation = {};  ///< by its angle
    Vec2 localCenter = {};  ///< of mass, in the body's frame                        [m]
    real mass = 0;  ///< 0: nothing moves it                                 [kg]
    real inertia = 0;  ///< about the center of mass; 0: nothing turns it       [kg*m^2]

    /// From the center of mass to a point of the body's frame, in the world's axes.   [m]
    Vec2 arm(Vec2 local) const noexcept { return rotate(rotation, local - localCenter); }
    /// A point of the body's frame, in the world.   [m]
    Position point(Vec2 local) const noexcept { return center + toDVec2(arm(local)); }
};

/// Takes down the rows of a constraint at a pose. Each begins with what it asks for, and goes on with how its
/// error changes as its bodies move:
///
///     rows.rigid(error).moveAt(0, -n, armA).moveAt(1, n, armB);
///
/// A constraint has the same rows in the same order at every pose: at most 6, of them 3 rigid ones, 3 limits,
/// 3 springs and 3 motors, springs and motors together no more than 4. What breaks this, numbers that are not
/// finite, and bodies that there are not, are faults: of a new joint they are refused by name, in a step the
/// joint exerts no force for a tick (half a sub-step) and StepReport::jointFaults counts it.
class ConstraintRows {
public:
    static constexpr int kMostRows = 6;
    static constexpr int kMostBodies = 8;

    /// What moves the error of a row: its direction in the space of the velocities of one body.
    struct Part {
        Vec2 linear = {};  ///< by a way of the center of mass [1]
        real turn = 0;  ///< by an angle                    [m] or [1]
    };

    /// One row, as it was taken down.
    struct Data {
        RowKind kind = RowKind::Rigid;
        bool angular = false;  ///< nothing but turns move it: C is an angle
        bool bears = false;  ///< a limit that bears loads: the end of a rope
        double error = 0;  ///< C                                                 [m] or [rad]
        real stiffness = 0;  ///< of a spring                                       [N/m] or [N*m/rad]
        real damping = 0;  ///< likewise                                          [N*s/m] or [N*m*s/rad]
        real speed = 0;  ///< of a motor                                        [m/s] or [rad/s]
        real most = kUnlimited;  ///< of a motor or a spring                          [N] or [N*m]
        std::array<Part, kMostBodies> parts = {};
    };

    /// A row that is being taken down. Bodies are named by their places, from 0.
    class Row {
    public:
        /// C grows by n . (the way of the body's center of mass).
        Row& move(int body, Vec2 n) noexcept { return add(body, n, 0); }
        /// C grows by n . (the way of the body's point at `arm` from its center of mass). The first such arm
        /// of a body is where the joint holds it, for readings.   [m]
        Row& moveAt(int body, Vec2 n, Vec2 arm) noexcept
        {
            rows_->holdAt(body, arm);
            return add(body, n, cross(arm, n));
        }
        /// C grows by `rate` * (the angle of the body).
        Row& turn(int body, real rate) noexcept { return add(body, {}, rate, true); }
        /// Of a motor or a spring: no more than this, either way.   [N] or [N*m]   >= 0
        Row& atMost(real force) noexcept
        {
            if (data_) data_->most = force;
            return *this;
        }
        /// Of a limit: it bears loads, as the end of a rope.
        Row& bears() noexcept
        {
            if (data_) data_->bears = true;
            return *this;
        }

    private:
        friend class ConstraintRows;
        Row(ConstraintRows* rows, Data* data) noexcept : rows_(rows), data_(data) {}
        Row& add(int body, Vec2 n, real turn, bool turns = false) noexcept
        {
            if (body < 0 || body >= rows_->bodies_) {
                rows_->complain("body", body, "must be one of those of the constraint");
            } else if (data_) {
                Part& part = data_->parts[static_cast<std::size_t>(body)];
                part.linear += n;
                part.turn += turn;
                if (!turns) data_->angular = false;
            }
            return *this;
        }

        ConstraintRows* rows_;
        Data* data_;
    };

    explicit ConstraintRows(int bodies) noexcept : bodies_(bodies) {}

    /// Its error is to be 0.   [m] or [rad]
    Row rigid(double error) noexcept { return add(RowKind::Rigid, error); }
    /// There is so much room left, and there is to be no less than none.   [m] or [rad]
    Row limit(double room) noexcept { return add(RowKind::Limit, room); }
    /// C is to grow at a speed, by no more than a force.   [m/s] or [rad/s], [N] or [N*m]
    Row motor(real speed, real maxForce) noexcept
    {
        Row row = add(RowKind::Motor, 0);
        if (row.data_) row.data_->speed = speed;
        return row.atMost(maxForce);
    }
    /// Is pulled to an error of 0.   [m] or [rad], [N/m] or [N*m/rad], [N*s/m] or [N*m*s/rad]
    Row spring(double error, real stiffness, real damping = 0) noexcept
    {
        Row row = add(RowKind::Spring, error);
        if (row.data_) {
            row.data_->stiffness = stiffness;
            row.data_->damping = damping;
        }
        return row;
    }
    /// Asks for nothing: what JointReading::position says, and, by what moves it, JointReading::speed.
    Row position(double value) noexcept
    {
        position_ = {};
        position_.angular = true;
        position_.error = value;
        return {this, &position_};
    }

    // --- for the solver

    int count() const noexcept { return count_; }
    const Data& operator[](int row) const noexcept { return data_[static_cast<std::size_t>(row)]; }
    const Data& reading() const noexcept { return position_; }
    Vec2 arm(int body) const noexcept { return arms_[static_cast<std::size_t>(body)]; }

    /// What was wrong first, if anything was: "rows[2].error", its value, and the rule.
    struct Problem {
        const char* field = nullptr;  ///< null: nothing is wrong
        int row = 0;
        double value = 0;
        const char* rule = nullptr;
    };
    const Problem& problem() const noexcept { return problem_; }
    void complain(const char* field, double value, const char* rule, int row = -1) noexcept
    {
        if (!problem_.field) problem_ = {field, row < 0 ? count_ - 1 : row, value, rule};
    }

private:
    Row add(RowKind kind, double error) noexcept
    {
        if (count_ == kMostRows) {
            complain("count", count_ + 1, "must be at most 6");
            return {this, nullptr};
        }
        Data& data = data_[static_cast<std::size_t>(count_++)];
        data.kind = kind;
        data.angular = true;
        data.error = error;
        return {this, &data};
    }
    void holdAt(int body, Vec2 arm) noexcept
    {
        if (body < 0 || body >= bodies_ || held_[static_cast<std::size_t>(body)]) return;
        held_[static_cast<std::size_t>(body)] = true;
        arms_[static_cast<std::size_t>(body)] = arm;
    }

    int bodies_, count_ = 0;
    std::array<Data, kMostRows> data_ = {};
    Data position_;
    std::array<Vec2, kMostBodies> arms_ = {};
    std::array<bool, kMostBodies> held_ = {};
    Problem problem_;
};

/// Says on how many bodies it acts: `static constexpr int bodies`, 1 to ConstraintRows::kMostBodies.
template <class T>
concept CountsBodies = requires {
    { T::bodies } -> std::convertible_to<int>;
    requires T::bodies >= 1 && T::bodies <= ConstraintRows::kMostBodies;
};

/// Measures its rows: `void measure(std::span<const ConstraintBody> at, ConstraintRows& rows) const`. The
/// same places must give the same rows, and it must not touch the World.
template <class T>
concept MeasuresRows =
    requires(const T& constraint, std::span<const ConstraintBody> at, ConstraintRows& rows) {
        { constraint.measure(at, rows) } -> std::same_as<void>;
    };

/// What a joint of your own is made of. It is copied once, and never changes. A
/// `static constexpr std::string_view name` is what messages call it.
template <class T>
concept Constraint = std::copy_constructible<T> && CountsBodies<T> && MeasuresRows<T>;

/// A joint of your own. Copies of it share one constraint.
class OwnJoint {
public:
    OwnJoint() = default;  ///< of nothing: refused by createJoint

    template <class T>
        requires(!std::same_as<T, OwnJoint>)
    explicit OwnJoint(const T& constraint)
    {
        static_assert(std::copy_constructible<T>, "a constraint must be copyable");
        static_assert(CountsBodies<T>, "a constraint needs `static constexpr int bodies`, 1 to 8");
        static_assert(MeasuresRows<T>,
                      "a constraint needs `void measure(std::span<const ConstraintBody> at, ConstraintRows& "
                      "rows) const`");
        if constexpr (Constraint<T>) model_ = std::make_shared<const ModelOf<T>>(constraint);
    }

    bool isNull() const noexcept { return model_ == nullptr; }
    /// On how many it acts; 0 of nothing.
    int bodies() const noexcept { return model_ ? model_->bodies : 0; }
    /// That of the constraint, or "OwnJoint".
    std::string_view name() const noexcept { return model_ ? model_->name : "OwnJoint"; }
    /// The constraint; null if it is of another type.
    template <class T>
    const T* as() const noexcept
    {
        if (!model_ || model_->type != &kTypeOf<T>) return nullptr;
        return &static_cast<const ModelOf<T>&>(*model_).constraint;
    }
    /// Calls the constraint's own function, and lets what it throws pass.
    void measure(std::span<const ConstraintBody> at, ConstraintRows& rows) const
    {
        if (model_) model_->measure(at, rows);
    }

    /// Are they of one and the same constraint?
    friend bool operator==(const OwnJoint& a, const OwnJoint& b) noexcept { return a.model_ == b.model_; }

private:
    template <class T>
    static constexpr char kTypeOf = 0;  // its address is the type's

    struct Model {
        int bodies = 0;
        std::string_view name = "OwnJoint";
        const void* type = nullptr;

        Model() = default;
        Model(const Model&) = delete;
        Model& operator=(const Model&) = delete;
        virtual ~Model() = default;
        virtual void measure(std::span<const ConstraintBody> at, ConstraintRows& rows) const = 0;
    };
    template <class T>
    struct ModelOf final : Model {
        T constraint;

        explicit ModelOf(const T& given) : constraint(given)
        {
            bodies = T::bodies;
            type = &kTypeOf<T>;
            if constexpr (requires { std::string_view(T::name); }) name = T::name;
        }
        void measure(std::span<const ConstraintBody> at, ConstraintRows& rows) const override
        {
            constraint.measure(at, rows);
        }
    };

    std::shared_ptr<const Model> model_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
