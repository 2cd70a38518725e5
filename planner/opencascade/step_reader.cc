#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <cmath>
#include <mutex>
#include <numbers>
#include <sstream>

#include "planner/mesh_import/files/library_mesh.h"

namespace assay::mesh_import {
namespace {

constexpr double kMetresPerMillimetre = 0.001;
// Sides of a circle: so many that its polygon is within 0.13 % of its radius.
constexpr double kSides = 64;
// Greatest distance of a triangle from its face, in parts of the size of the whole. Circles need
// fewer sides for it than `kSides`.
constexpr double kDeflection = 0.001;

// The library's settings are global, and it writes messages to the standard output.
void Prepare() {
  static std::once_flag once;
  std::call_once(once, [] {
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
    STEPControl_Reader();  // defines the settings
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  });
}

// Adds the triangles of a face, which look out of the solid.
void Add(const TopoDS_Face& face, LibrarySurface& surface) {
  TopLoc_Location place;
  const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, place);
  if (triangles.IsNull()) return;
  const int first = static_cast<int>(surface.vertices.size());
  for (int i = 1; i <= triangles->NbNodes(); ++i) {
    const gp_Pnt p = triangles->Node(i).Transformed(place.Transformation());
    surface.vertices.emplace_back(kMetresPerMillimetre * Vector3(p.X(), p.Y(), p.Z()));
  }
  const bool is_turned =
      (face.Orientation() == TopAbs_REVERSED) != place.Transformation().IsNegative();
  for (int i = 1; i <= triangles->NbTriangles(); ++i) {
    int a = 0;
    int b = 0;
    int c = 0;
    triangles->Triangle(i).Get(a, b, c);
    if (is_turned) std::swap(b, c);
    surface.triangles.push_back({first + a - 1, first + b - 1, first + c - 1});
  }
}

// Cuts the faces of a shape into triangles. Faces that share an edge share its corners.
LibrarySurface Triangulated(const TopoDS_Shape& shape) {
  Bnd_Box bounds;
  BRepBndLib::Add(shape, bounds);
  LibrarySurface surface;
  if (bounds.IsVoid()) {
    surface.error = "it has no faces";
    return surface;
  }
  const double size = std::sqrt(bounds.SquareExtent());
  // The library takes half of this angle between neighbouring sides.
  const BRepMesh_IncrementalMesh mesh(shape, kDeflection * size, false,
                                      4 * std::numbers::pi / kSides);
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
    Add(TopoDS::Face(face.Current()), surface);
  if (surface.triangles.empty()) surface.error = "it has no faces";
  return surface;
}

class StepReader : public MeshLibrary {
 public:
  LibrarySurface Read(std::string_view text) const override {
    Prepare();
    LibrarySurface refused;
    try {
      STEPControl_Reader reader;
      std::istringstream stream{std::string(text)};
      if (reader.ReadStream("file", stream) != IFSelect_RetDone) {
        refused.error = "its entities cannot be read";
        return refused;
      }
      reader.TransferRoots();
      if (reader.NbShapes() > 0) return Triangulated(reader.OneShape());
      refused.error = "it has no shapes";
    } catch (const Standard_Failure& failure) {
      refused.error = failure.GetMessageString();
    }
    return refused;
  }
};

}  // namespace
}  // namespace assay::mesh_import

// The function that mesh_import::ReadLibraryMesh looks up in the module.
extern "C" const assay::mesh_import::MeshLibrary* AssayStepReader() {
  static const assay::mesh_import::StepReader reader;
  return &reader;
}
