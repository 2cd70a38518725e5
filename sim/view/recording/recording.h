#pragma once

#include <string>
#include <vector>

#include "sim/execution/trace/trace.h"
#include "sim/scene/scene.h"
#include "sim/view/recording/contact_series.h"
#include "sim/view/stage.h"

namespace assay::view {

// What a page shows at each time: the samples of a trace, as series of whole numbers that
// EncodedSeries has encoded, one after the other. page/data.md lists the series.
struct Recording {
  std::size_t samples = 0;
  std::string bytes;
  ContactSeries contacts;  // empty if the trace has no contact points
};

// The units of a recording's whole numbers. Forces and torques have kForceQuantum.
inline constexpr double kTimeQuantum = 1e-4;         // seconds
inline constexpr double kLengthQuantum = 1e-5;       // metres
inline constexpr double kTurnQuantum = 1.0 / 32768;  // of each number of a unit quaternion

// Records the bodies at their true poses and the parts at their believed poses. The trace must be
// one of an execution in the scene, with samples.
Recording Record(const scene::Scene& scene, const std::vector<Body>& bodies,
                 const execution::Trace& trace);

}  // namespace assay::view
