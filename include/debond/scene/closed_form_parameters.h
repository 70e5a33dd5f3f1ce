#ifndef debond_scene_closed_form_parameters_h
#define debond_scene_closed_form_parameters_h

namespace Debond
{
  class EntryTable;

  /** The subsection `Closed form` of a scene: what the models foundation,
   *  analytical and mathieu need besides the other entries. */
  struct ClosedFormParameters
  {
    double pressure            = 0;    ///< p [MPa], 0: from the push-in
    double normal_stiffness    = 0;    ///< p / d [MPa/mm], 0: from the bulk
    double torsional_stiffness = 0;    ///< lambda [MPa/mm], 0: from the bulk
    double linear_limit        = 0.13; ///< theta_lin [deg]
    double full_sliding        = 1.13; ///< theta_max [deg]
    double shear_modulus       = 40.4; ///< G [MPa]
    double adhesion_energy     = 22.2; ///< w_adh [N/m]

    void
    declare(EntryTable &table);
  };
} // namespace Debond
#endif
