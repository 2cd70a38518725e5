#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/mesh_import/sections/columns.h"

namespace assay::mesh_import {

// A bevelled edge around an end, in metres across the axis and along it. 0 means none.
struct Chamfer {
  double across = 0;
  double along = 0;
};

// An extrusion along z, or a body that tapers evenly along z. Chamfers are not in its contours.
struct Post {
  Contour at_low = {};
  Contour at_high = {};
  bool is_straight = true;  // both contours are equal
  bool is_step = false;     // it stands for sections that are not equal
  double low = 0;           // z, metres
  double high = 0;
  Chamfer chamfer_low = {};
  Chamfer chamfer_high = {};
  std::optional<Vector2> mouth = {};  // of a slot in a side: the outward normal of the side

  double Height() const { return high - low; }
  double Volume(bool is_hole) const;      // chamfers narrow a solid and widen a hole
  bool Contains(const Vector3& p) const;  // ends included
};

struct StackPocket {
  Post post;
  int solid = 0;             // index of the solid that it is cut from
  bool reaches_low = false;  // whether it opens in the low end of its solid
  bool reaches_high = false;
};

// A body as extrusions along z, and pockets that are cut from them.
struct Stack {
  std::vector<Post> solids;
  std::vector<StackPocket> pockets;
  std::string reason;  // why the columns make no stack; empty if they do

  std::size_t Count() const { return solids.size() + pockets.size(); }
  // Returns a cost that is small if the stack describes the body well. For example, a blind hole
  // that is seen along its axis costs less than one that is seen as a slot with closed ends.
  std::size_t Cost() const;
  double Volume() const;  // of the solids without the pockets
};

// Makes solids of the columns of a mesh and pockets of its holes. A tapered end of a solid or of
// the mouth of a hole becomes a chamfer.
Stack StackOf(const std::vector<Column>& columns, const ColumnRules& rules);

}  // namespace assay::mesh_import
