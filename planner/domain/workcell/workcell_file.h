#pragma once

#include <filesystem>
#include <memory>

#include "planner/base/input_files/document.h"
#include "planner/domain/units/units.h"
#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// Returns `given` with the rules that the map names replaced. The keys are the names of the rules
// in WorkcellRules. Throws InputError for unknown rules, for values out of range, and for a grip
// force that a finger of the gripper does not have.
WorkcellRules ReadRules(const Value& map, const Units& units, const kinematics::Gripper& gripper,
                        const WorkcellRules& given);

// Builds a workcell from its file.
class WorkcellFile {
 public:
  // Reads models/workcells/NAME/workcell.yaml ("assay-workcell/1") and the URDF files that it
  // names.
  static std::shared_ptr<const Workcell> Read(const std::filesystem::path& file);

 private:
  explicit WorkcellFile(const std::filesystem::path& file);

  void ReadTables(const Value& root);
  void ReadTable(const std::string& name, const Value& table);
  void ReadAllRules(const Value& rules);
  void ReadPlacements(const Value& placements);
  void ReadPlaces(const Value& places);

  std::filesystem::path folder_;
  Units units_;
  std::shared_ptr<Workcell> workcell_;
};

}  // namespace assay::domain
