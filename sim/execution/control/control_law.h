#pragma once

#include "planner/plan/certificates/pushing.h"

namespace assay::execution {

// The parameters of hybrid control. Lengths are in metres, forces in newtons, times in seconds.
struct ControlLaw {
  double free_speed = 0.005;      // m/s, of motions in which nothing should touch
  double contact_speed = 0.0025;  // m/s, of motions that a contact ends
  double sliding_speed = 0.01;    // m/s, along a crevice and where contacts are kept
  double seating_length = 0.004;  // length before a crevice's end where the contact speed applies
  double turning_speed = 0.12;    // rad/s
  double contact_turning_speed = 0.05;
  double pressing_force = 4;                   // force on each kept contact
  double pushing_force = plan::kStrategyPush;  // greatest force along a crevice
  double touching_force = 3;  // a contact that bears this is made, where others are kept
  // A contact that bears this counts as made, where no other contacts are kept.
  double first_touching_force = 1;
  double obstructing_force = 15;  // a greater force that no contact explains is an obstruction
  double force_limit = 60;        // lasting force at the wrist at which the arm stops
  // The force of an impact divided by its speed, in N s/m. The measured wrench is filtered and the
  // arm is heavy, so control does nothing during the two or three milliseconds in which the force
  // rises. In that time, a mass m that meets a stiffness k with speed v bears v sqrt(m k).
  double impact = 25e3;
  double softness = 0.03;              // fraction of the servos' stiffness
  double relaxation = 40;              // rate at which forces that are too great are relaxed, 1/s
  double seeking_speed = 0.002;        // m/s, toward a contact that is lost
  double yielding_speed = 0.005;       // m/s, away from a force that is too great
  double wrench_filter = 0.002;        // time constant of the measured wrench
  double velocity_filter = 0.01;       // time constant of the yielding velocity
  double acceleration = 0.3;           // m/s^2 in planned motions
  double turning_acceleration = 2;     // rad/s^2 in planned motions
  double touch_filter = 0.008;         // time constant of the force on an awaited contact
  double location_filter = 0.05;       // time constant of the contacts' locations
  double obstruction_duration = 0.05;  // an unexplained force that lasts so long is no impact
  // Time constant of the wrench by which error states are recognized.
  double recognition_filter = 0.02;
  double settling = 0.1;   // least time after each motion
  double braking = 0.002;  // time to stop when a contact is made
  double slack = 1e-4;     // metres by which a contact may be farther away than errors explain
  int attempts = 3;        // number of attempts at the whole strategy

  // Returns the greatest force at the wrist, in newtons, for any duration. It is the force of an
  // impact at the speed of free motions, plus the pushing force. After the first error state, no
  // motion is faster than a motion to a contact. Before it, only slides are faster, and the
  // strategy is certain that a slide meets nothing else.
  double GreatestForce() const { return pushing_force + impact * free_speed; }
};

}  // namespace assay::execution
