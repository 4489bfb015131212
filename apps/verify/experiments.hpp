// SPDX-License-Identifier: MIT
#pragma once

#include "report.hpp"

// The experiments, one function a group of rows.
namespace tamias2d::verify {

void freeMotion(Report& report);    ///< closed forms of IM1, IM2
void placeForces(Report& report);   ///< oscillator and orbit: forces that depend on place
void bounces(Report& report);       ///< peaks after many bounces, restitution, walls
void impacts(Report& report);       ///< velocities after one impact: DD8, cradles
void gases(Report& report);         ///< energy and momentum of many
void sliding(Report& report);       ///< tiles and slopes
void tunnelling(Report& report);    ///< fast and thin
void stacks(Report& report);        ///< stacks, pyramid, pile: calm, sag, overlap
void fineSteps(Report& report);     ///< some of them with shorter steps
void sharedScenes(Report& report);  ///< for Pymunk
void timing(Report& report);        ///< ms a step, as ratios

// Scenes that more than one of them uses.
Scene gasScene(int discs, int boxes, double restitution);
Scene stackScene(const EngineKind& kind, int count, double offset = 0, unsigned seed = 1);
Scene pyramidScene(const EngineKind& kind, int base);
Scene pileScene(int count, unsigned seed);
Scene clusterScene(double friction);
Scene dropScene(const EngineKind& kind, double height, double restitution);

}  // namespace tamias2d::verify
