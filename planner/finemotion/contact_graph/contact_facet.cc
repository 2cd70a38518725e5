#include "planner/finemotion/contact_graph/contact_facet.h"

#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::finemotion {

ContactFacet FacetOf(const CSurfaces& surfaces, const SurfaceSet& set) {
  ContactFacet facet;
  facet.set = set;
  for (int k = 0; k < surfaces.size(); ++k) {
    if (Contains(set, k)) facet.surfaces.push_back(k);
  }
  if (facet.surfaces.empty()) {
    facet.tangents = ContactFacet::Tangents::Identity(kPoseDimensions, kPoseDimensions);
    return facet;
  }
  Eigen::MatrixXd normals(kPoseDimensions, std::ssize(facet.surfaces));
  for (std::size_t i = 0; i < facet.surfaces.size(); ++i) {
    normals.col(static_cast<Eigen::Index>(i)) = surfaces.Row(facet.surfaces[i]);
  }
  const numeric::IndependentColumns independent =
      numeric::IndependentColumnsOf(normals, kDependentRow);
  facet.tangents = independent.complement;
  for (const int column : independent.columns)
    facet.independent.push_back(facet.surfaces[static_cast<std::size_t>(column)]);
  facet.corrections = -independent.dual;
  return facet;
}

ScaledPose Onto(const CSurfaces& surfaces, const ContactFacet& facet, const ScaledPose& x) {
  ScaledPose onto = x;
  for (std::size_t i = 0; i < facet.independent.size(); ++i) {
    const int k = facet.independent[i];
    const double gap = surfaces.Row(k).dot(x) + surfaces.Offset(k);
    onto += gap * facet.corrections.col(static_cast<Eigen::Index>(i));
  }
  return onto;
}

}  // namespace assay::finemotion
