// The work of the chuck is strain energy, energy of the interface and
// dissipation; what is missing is the error of trapezoids and falls with the
// step size. Dissipation never exceeds the work, nor adhesion the dissipation.

#include "driven_scene.h"

const char *const scene_text = R"(
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 4 * max(t - 1, 0)
  end
end
)";

void
check(const std::string &material)
{
  std::cout << material << std::endl;
  double before = 0;
  for (const unsigned int n : {50, 100, 200, 400})
    {
      const auto rows =
        run_scene(material + std::to_string(n),
                  scene_text,
                  {"Bone/Material=" + material,
                   "Implant/Material=" + material,
                   "Load steps/Steps=" + std::to_string(n / 10) + ", " +
                     std::to_string(n)});
      double defect = 0, over_bound = 0;
      bool   dissipates_less = true, adhesion_is_part = true, grows = true;
      for (std::size_t i = 1; i < rows.size(); ++i)
        {
          const auto &row = rows[i];
          grow(defect, std::abs(row.energy_defect));
          grow(over_bound,
               std::abs(row.energy_defect) / row.energy_defect_bound);
          dissipates_less =
            dissipates_less && row.dissipation_Nmm <= row.work_Nmm;
          adhesion_is_part =
            adhesion_is_part && row.adhesive_work_Nmm <= row.dissipation_Nmm;
          grows = grows && row.dissipation_Nmm >= rows[i - 1].dissipation_Nmm &&
                  row.adhesive_work_Nmm >= rows[i - 1].adhesive_work_Nmm;
        }
      std::cout << n << " steps" << std::endl;
      if (before > 0)
        report("  energy defect relative to that of half the steps",
               defect / before,
               0.5);
      before = defect;
      report("  energy defect relative to its bound", over_bound, 1);
      report("  dissipation is at most the work", dissipates_less);
      report("  adhesion is part of the dissipation", adhesion_is_part);
      report("  both only grow", grows);
      report("  both are there",
             rows.back().adhesive_work_Nmm > 0.01 * rows.back().work_Nmm &&
               rows.back().dissipation_Nmm > 0.5 * rows.back().work_Nmm);
    }
  report("energy defect with 400 steps", before, 1e-6);
}



void
test()
{
  check("neo-hookean");
  check("rigid");
}



int
main()
{
  return run_test(test);
}
