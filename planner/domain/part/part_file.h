#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/domain/part/part_model.h"
#include "planner/domain/problem/units.h"

namespace assay::domain {

// Reads a part file ("assay-part/1") and computes the model from it. models/parts/README.md
// describes the format. The object lives as long as the reading.
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

  // A solid of the file: a box, and the smaller boxes that remain of it after the pockets are cut.
  struct Solid {
    std::string name;
    Pose X_PartSolid = Pose::Identity();  // turn from the coordinates of the file
    geometry::Box whole;                  // before the turn and the pockets
    std::vector<geometry::Box> pieces;    // part frame
    Eigen::Vector4f color;
  };
  struct Pocket {
    std::string name;
    int solid = 0;      // index of the solid that it is cut from
    geometry::Box box;  // widened, not clipped; in the coordinates of the solid before its turn
    std::array<bool, 3> is_widened = {};  // along x, y, z
  };

  explicit PartFile(double clearance) : clearance_(clearance) {}

  // Reads units, solids and pockets.
  void ReadPieces(const Value& root);
  void ReadSolids(const Value& solids);
  Solid ReadSolid(const std::string& name, const Value& entry) const;
  Pose ReadTurn(const Value& turn) const;
  void ReadPockets(const Value& pockets);
  Pocket ReadPocket(const std::string& name, const Value& entry) const;
  static std::array<bool, 3> ReadWidening(const Value& axes);
  void Widen(const Value& entry, Pocket& pocket) const;
  geometry::Box ReadBox(const Value& corners) const;

  std::vector<geometry::Box> Pieces() const;
  void CheckHangsTogether(const Value& solids) const;
  void BuildShape(PartModel& model, double density) const;

  void ReadFeatures(const Value& features, PartModel& model) const;
  Feature ReadFeature(const Value& entry, const PartModel& model) const;
  void ReadFace(const Value& entry, const PartModel& model, Feature& feature) const;
  void ReadHole(const Value& entry, const PartModel& model, Feature& feature) const;
  void ReadShaft(const Value& entry, const PartModel& model, Feature& feature) const;
  int SolidNamed(const Value& name) const;
  // Return the indices for one name or a list of names.
  std::vector<int> SolidsNamed(const Value& names) const;
  std::vector<int> PocketsNamed(const Value& names) const;

  double clearance_;
  Units units_;
  std::vector<Solid> solids_;
  std::vector<Pocket> pockets_;
};

}  // namespace assay::domain
