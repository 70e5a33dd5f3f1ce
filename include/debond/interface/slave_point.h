#ifndef debond_interface_slave_point_h
#define debond_interface_slave_point_h

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_point.h>

namespace Debond
{
  /** A quadrature point of the slave surface: where it lies, its history, and
   *  what it contributes in the trial state. */
  struct SlavePoint : SurfaceQuadraturePoint
  {
    double            phi_0 = 0;
    ContactPointState accepted;
    /** For points beyond the master's edge: how far the surfaces may still
     *  move before such a point has to be projected again [mm]. */
    double clearance = 0;
    /** Tangential traction of the accepted state in the master's frame [MPa].
     */
    Eigen::Vector3d    accepted_traction         = Eigen::Vector3d::Zero();
    Eigen::Vector3d    accepted_viscous_traction = Eigen::Vector3d::Zero();
    double             accepted_pressure         = 0; ///< [MPa]
    double             accepted_energy           = 0; ///< [N/mm]
    ContactPointResult trial;
    /** False for points of a bone that does not face the implant at the
     *  start: their area does not count. */
    bool faces_implant = true;

    /** phi and mu in one of its states. */
    FrictionCoefficient
    friction(const FrictionLaw &law, const ContactPointState &state) const
    {
      return law.reported(friction_state(state, phi_0));
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &accepted &clearance       &accepted_traction;
      archive &accepted_viscous_traction &accepted_pressure;
      archive                            &accepted_energy;
      if (Archive::is_loading::value)
        trial.state = accepted;
    }
  };
} // namespace Debond
#endif
