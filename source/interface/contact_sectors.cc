#include <debond/bulk/bulk_space.h>
#include <debond/interface/contact_interface.h>
#include <debond/support/input_error.h>

#include <cmath>
#include <string>
#include <utility>

// Where bodies, bond and load have a cyclic symmetry the points of one sector
// are updated, each with the area of all its images, and what they exert is
// turned into the others.
namespace Debond
{
  // The bond may be without the symmetry that its surfaces have.
  bool
  ContactInterface::keep_one_sector(
    const SectorsOfSurfaces &sectors_of_surfaces)
  {
    const auto               &images = sectors_of_surfaces[slave].points;
    std::vector<SlavePoint>   kept;
    std::vector<unsigned int> numbers(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const SlavePoint &first = points[images[q].first];
        if (std::abs(points[q].phi_0 - first.phi_0) > 1e-12 ||
            points[q].faces_implant != first.faces_implant)
          return false;
        numbers[q] =
          images[q].first == q ? kept.size() : numbers[images[q].first];
        if (images[q].first != q)
          continue;
        kept.push_back(points[q]);
        kept.back().n_images = images[q].n;
        kept.back().JxW *= images[q].n;
      }
    points         = std::move(kept);
    number_of_kept = std::move(numbers);
    sectors = std::make_unique<const SectorsOfSurfaces>(sectors_of_surfaces);
    return true;
  }



  void
  ContactInterface::average(NodalSums &sums) const
  {
    if (sectors)
      for (const Side side : both_sides)
        (*sectors)[side].average(sums[side]);
  }



  // An extension of a run may leave the symmetry that it had.
  void
  ContactInterface::refuse_sectors(const unsigned int saved) const
  {
    throw ForeignCheckpoint(
      "Load steps / Cyclic symmetry: the run was computed in " +
      std::to_string(saved) + " like sectors, and this scene has " +
      std::to_string(n_sectors()) +
      ": where load or bond leave the symmetry later on, begin anew with none");
  }



  // What is a vector in space is turned; numbers are the same.
  const std::vector<SlavePoint> &
  ContactInterface::points_of_all_sectors(std::vector<SlavePoint> &images) const
  {
    if (!sectors)
      return points;
    const CyclicSymmetry &of_slave = (*sectors)[slave];
    const auto places = surface_quadrature(mesh[slave]->surface(), along);
    images.clear();
    images.reserve(places.size());
    for (unsigned int q = 0; q < places.size(); ++q)
      {
        SlavePoint &point = images.emplace_back(points[number_of_kept[q]]);
        static_cast<SurfaceQuadraturePoint &>(point) = places[q];
        point.n_images                               = 1;
        const Eigen::Matrix3d turn = of_slave.turn[of_slave.points[q].turns];
        for (Eigen::Vector3d *const vector : {&point.trial.traction,
                                              &point.trial.tangential_traction,
                                              &point.trial.viscous_traction,
                                              &point.trial.slip_increment})
          *vector = turn * vector->eval();
      }
    return images;
  }
} // namespace Debond
