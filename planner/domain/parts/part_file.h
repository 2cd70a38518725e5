#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/parts/part_model.h"
#include "planner/domain/parts/part_solids.h"
#include "planner/domain/units/units.h"

namespace assay::domain {

// Reads a part file ("assay-part/1") and computes the model from it. models/parts/README.md
// describes the format. The object exists only while the file is read.
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

 private:
  static geometry::MassProperties ReadMass(const Document& document, double clearance);

  using Solid = PartSolids::Solid;

  PartFile(const Value& root, double clearance);  // reads units, solids and pockets

  void BuildShape(PartModel& model, double density) const;

  void ReadFeatures(const Value& features, PartModel& model) const;
  Feature ReadFeature(const Value& entry, const PartModel& model) const;
  std::vector<Feature> ReadFaces(const Value& entry, const PartModel& model) const;
  static void ReadFace(const Solid& solid, const Value& normal, const PartModel& model,
                       Feature& feature);
  void ReadHole(const Value& entry, const PartModel& model, Feature& feature) const;
  void ReadShaft(const Value& entry, const PartModel& model, Feature& feature) const;

  Units units_;
  PartSolids solids_;
};

}  // namespace assay::domain
