#pragma once

#include "planner/plan/data/pushing.h"

namespace assay::exec {

// The numbers of hybrid control. Lengths in metres, forces in newtons, times in seconds.
struct ControlLaw {
  double free_speed = 0.005;      // of motions that nothing is to touch in, m/s
  double contact_speed = 0.0025;  // of motions that a contact ends, m/s
  double sliding_speed = 0.01;    // along a crevice, and where contacts are kept, m/s
  double seating_length = 0.004;  // before a crevice's end, where it is as slow as to touch
  double turning_speed = 0.12;    // rad/s
  double contact_turning_speed = 0.05;
  double pressing_force = 4;                   // on each contact that is kept
  double pushing_force = plan::kStrategyPush;  // along a crevice, at most
  double touching_force = 3;        // on a contact that counts as made, where others are kept
  double first_touching_force = 1;  // where no others are
  double obstructing_force = 15;    // that no contact explains
  double force_limit = 60;          // at the wrist, of what lasts: then the arm stops
  // N s/m: how hard an impact is for its speed. What is felt is filtered and the arm is heavy, so
  // that control does nothing while the force rises, for two or three milliseconds: a mass m that
  // meets a stiffness k with speed v bears v sqrt(m k) then.
  double impact = 20e3;
  double softness = 0.03;         // share of the servos' stiffness
  double relaxation = 40;         // of forces that are too much, 1/s
  double seeking_speed = 0.002;   // of a contact that is lost, m/s
  double yielding_speed = 0.005;  // to a force that is too much, m/s
  double wrench_filter = 0.002;   // time constants
  double velocity_filter = 0.01;
  double acceleration = 0.3;           // of planned motions, m/s^2
  double turning_acceleration = 2;     // rad/s^2
  double touch_filter = 0.008;         // of a contact that is waited for
  double location_filter = 0.05;       // of where contacts are felt
  double obstruction_duration = 0.05;  // longer than an impact takes
  double recognition_filter = 0.02;    // of what error states are recognized by
  double settling = 0.1;               // after each motion, at least
  double braking = 0.002;              // when a contact is made
  double slack = 1e-4;                 // that a contact may be farther away than errors explain, m
  int attempts = 3;                    // at all of the strategy, from error states

  // Newtons at the wrist, however short: an impact at the speed of free motions, and what is
  // pressed on besides. From the first error state on nothing is faster; before, only what slides
  // is, where the strategy is certain that nothing else is met.
  double GreatestForce() const { return pushing_force + impact * free_speed; }
};

}  // namespace assay::exec
