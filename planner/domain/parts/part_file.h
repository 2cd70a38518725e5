#pragma once

#include <filesystem>
#include <memory>

#include "planner/base/input_files/document.h"
#include "planner/domain/parts/part_model.h"

namespace assay::domain {

// Part files ("assay-part/1") and the models that are computed from them. models/parts/README.md
// describes the format.
class PartFile {
 public:
  // Reads models/parts/NAME/part.yaml. `clearance` is in metres, on each side of the axes along
  // which a pocket is to be widened; a negative clearance narrows it. Throws InputError at the
  // place of what is wrong.
  static std::shared_ptr<const PartModel> Load(const std::filesystem::path& file, double clearance);
  static std::shared_ptr<const PartModel> Read(const Document& document, double clearance);

  // Reads and computes the same part anew with another clearance. Below 0, shafts are too wide for
  // their holes. Throws InputError if a pocket becomes impossible.
  static std::shared_ptr<const PartModel> WithClearance(const PartModel& model, double clearance);
  static geometry::MassProperties MassWithClearance(const PartModel& model, double clearance);
};

}  // namespace assay::domain
