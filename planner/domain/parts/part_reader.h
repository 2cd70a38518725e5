#pragma once

#include <memory>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/parts/part_model.h"
#include "planner/domain/parts/solids/part_solids.h"
#include "planner/domain/units/units.h"

namespace assay::domain {

// The reader of a part file (part_file.h). It exists only while the file is read.
class PartReader {
 public:
  // Reads units, solids and pockets. `root` and `clearance` are as in PartFile::Read.
  PartReader(const Value& root, double clearance);

  std::shared_ptr<const PartModel> Model(const Document& document) const;
  geometry::MassProperties Mass() const;

 private:
  using Solid = PartSolids::Solid;

  void BuildShape(PartModel& model, double density) const;

  void ReadFeatures(const Value& features, PartModel& model) const;
  Feature ReadFeature(const Value& entry, const PartModel& model) const;
  std::vector<Feature> ReadFaces(const Value& entry, const PartModel& model) const;
  static void ReadFace(const Solid& solid, const Value& normal, const PartModel& model,
                       Feature& feature);
  void ReadHole(const Value& entry, const PartModel& model, Feature& feature) const;
  void ReadShaft(const Value& entry, const PartModel& model, Feature& feature) const;

  Value root_;
  Units units_;
  double clearance_;
  PartSolids solids_;
};

}  // namespace assay::domain
