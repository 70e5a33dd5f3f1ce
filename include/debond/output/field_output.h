#pragma once

#include <debond/output/bulk_fields.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  class CoupledSystem;
  class ResultDirectory;

  /**
   * Writes what ParaView shows: bulk-NNNN.vtu, interface-NNNN.vtu and
   * points-NNNN.vtu with the series bulk.pvd, interface.pvd and points.pvd,
   * which are replaced as a whole after each call, so that the files of an
   * interrupted run can be opened. No file holds a date: equal runs write equal
   * files. Several ranks write a piece of the bulk each, bulk-NNNN.RANK.vtu,
   * joined by bulk-NNNN.pvtu.
   *
   * Points lie at their *reference* positions X, and the array `displacement`
   * is x - X in space, the rigid motion of the implant included: the filter
   * Warp By Vector shows the deformed state. Splines and quadratic elements are
   * cells of degree 2. Trilinear elements at a curved contact surface are drawn
   * in pieces, the contact surface itself in more; all points are where the
   * model has them.
   *
   * doc/reference/results.md says which arrays there are. Those of the
   * interface are known at the quadrature points, which points-NNNN.vtu has as
   * they are, with what is summed up (PointLoad). Between these they are
   * interpolated bilinearly in the parameters of the surface, across the
   * borders of elements, and constant beyond the outermost points, so that
   * nothing overshoots; `state` is that of the nearest point. phi_0, which may
   * jump from element to element, is interpolated between the points of each
   * element alone, and phi and mu are those of the friction law for this phi_0
   * and the interpolated sliding distance.
   */
  class FieldOutput
  {
  public:
    /** Keeps references. */
    FieldOutput(const ResultDirectory &directory, const CoupledSystem &system)
      : directory(directory)
      , system(system)
    {}

    /** Writes the accepted state as the next file of each series. Throws
     * WriteError if that is impossible. Collective. */
    void
    write(double time);

    /** Waits until all files are on the disk. Throws WriteError. */
    void
    put_on_disk();

    /** Members of summary.json: bone_tension_MPa, the largest BoneTension of
     *  all files, bone_tension_at_mm and bone_tension_time; none without
     *  files or tension. */
    nlohmann::ordered_json
    measures() const;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &files &largest_tension;
      if (Archive::is_loading::value)
        n_on_disk = files["bulk"].size();
    }

  private:
    const ResultDirectory &directory;
    const CoupledSystem   &system;
    BoneTension            largest_tension;
    /** Times and names, by series. */
    std::map<std::string, std::vector<std::pair<double, std::string>>> files;
    std::size_t n_on_disk = 0; ///< of each series
  };

} // namespace Debond
