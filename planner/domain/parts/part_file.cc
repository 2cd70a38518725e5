#include "planner/domain/parts/part_file.h"

#include <cmath>

#include "planner/base/check.h"
#include "planner/domain/parts/part_reader.h"
#include "planner/domain/parts/part_shape.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {

std::shared_ptr<const PartModel> PartFile::Load(const std::filesystem::path& file,
                                                double clearance) {
  return Read(Document::Load(file), clearance);
}

std::shared_ptr<const PartModel> PartFile::Read(const Document& document, double clearance) {
  ASSAY_CHECK(std::isfinite(clearance));
  document.RequireFormat("assay-part/1");
  document.root().AllowOnly({"format", "name", "initial", "units", "density", "friction", "solids",
                             "pockets", "features", "stable_poses"});
  return PartReader(document.root(), clearance).Model(document);
}

std::shared_ptr<const PartModel> PartFile::WithClearance(const PartModel& model, double clearance) {
  return Read(model.file_, clearance);
}

geometry::MassProperties PartFile::MassWithClearance(const PartModel& model, double clearance) {
  const std::lock_guard lock(model.shape_->mass_mutex);
  std::map<double, geometry::MassProperties>& known = model.shape_->mass_with_clearance;
  const auto found = known.find(clearance);
  if (found != known.end()) return found->second;
  return known[clearance] = PartReader(model.file_.root(), clearance).Mass();
}

}  // namespace assay::domain
