#ifndef debond_output_field_output_h
#define debond_output_field_output_h

#include <debond/output/bulk_fields.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <string>
#include <vector>

namespace Debond
{
  class ContactInterface;
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
    /** Keeps references to everything. */
    FieldOutput(const ResultDirectory  &directory,
                const Body             &bone,
                const Body             &implant,
                const ContactInterface &interface,
                const Chuck            &chuck);

    /** Writes the accepted state as the next file of each series. Throws
     * WriteError if that is impossible. Collective. */
    void
    write(double time);

    /** For a run that goes on from a checkpoint: forgets what was written after
     *  it. Returns a warning if a file of before is missing, or nothing. */
    std::string
    forget_later_files();
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
      archive &times &n_pieces &largest_tension;
    }

  private:
    void
    write_series() const;
    std::string
    file_name(const std::string &series, unsigned int number) const;

    const ResultDirectory            &directory;
    const std::array<const Body *, 2> bodies; ///< bone, implant
    const ContactInterface           &interface;
    const Chuck                      &chuck;
    BoneTension                       largest_tension;
    std::vector<double>               times;         ///< of the files
    std::vector<unsigned int>         n_pieces;      ///< of the bulk in each
    std::size_t                       n_on_disk = 0; ///< files of each series
  };

  /** The text of a VTU file with the fields of the interface in the trial state
   *  on the surface of the body @p slave; class FieldOutput says which, and how
   *  they are interpolated. */
  std::string
  interface_vtu(const Body             &slave,
                const ContactInterface &interface,
                const Chuck            &chuck);
  /** The same of the quadrature points. */
  std::string
  points_vtu(const Body             &slave,
             const ContactInterface &interface,
             const Chuck            &chuck);
} // namespace Debond
#endif
