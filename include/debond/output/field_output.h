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
   * Writes what ParaView shows: bulk-NNNN.vtu and interface-NNNN.vtu with the
   * series bulk.pvd and interface.pvd, which are replaced as a whole after each
   * call, so that the files of an interrupted run can be opened. No file holds
   * a date: equal runs write equal files. Several ranks write a piece of the
   * bulk each, bulk-NNNN.RANK.vtu, joined by bulk-NNNN.pvtu.
   *
   * Points lie at their *reference* positions X, and the array `displacement`
   * is x - X in space, the rigid motion of the implant included: the filter
   * Warp By Vector shows the deformed state. Splines and quadratic elements are
   * cells of degree 2. Trilinear elements at a curved contact surface are drawn
   * in pieces, by polynomials that interpolate the model (1e-5 mm for a coin);
   * the contact surface is drawn as the model has it, in more pieces.
   *
   * Arrays of the bulk (both bodies):
   *  - displacement [mm]; displacement_in_frame, v in the body's own frame
   * [mm];
   *  - von_Mises_MPa and stress_MPa, the Cauchy stress in space as a tensor
   * (see Bulk::vertex_stress(); zero in a rigid body);
   *  - body: 0 bone, 1 implant.
   *
   * Arrays of the interface (the slave surface):
   *  - pressure_MPa; traction_MPa, the tangential traction that acts *on the
   *    slave* (minus ContactPointResult::tangential_traction);
   *  - gap_mm, normal, negative in contact; 0 where `state` is 0 and the point
   *    has no partner because it lies beyond the master's edge;
   *  - slip_mm, the accumulated sliding distance g_s; phi_0, phi, mu;
   *  - state: 0 open, 1 stick, 2 slip, 3 pulled;
   *  - of laws with strength in tension left_by_opening, left_by_slip and
   *    mode_deg (BondLeft, PointTraction);
   *  - displacement [mm].
   * They are known at the quadrature points. Between these they are
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

    /** Writes the trial state (the accepted one, if called after commit()) as
     *  the next file of both series. Throws WriteError if that is impossible.
     *  Collective. */
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
} // namespace Debond
#endif
