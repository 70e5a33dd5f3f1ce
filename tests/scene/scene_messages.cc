// Every kind of mistake in a scene is answered by one message that says where
// it is, what was read and what is allowed.

#include <debond/scene/scene.h>

#include <iostream>
#include <string>
#include <vector>

namespace
{
  const std::string turning = "subsection Chuck\n"
                              "  subsection Rotation z\n"
                              "    set Value = 10 * t\n"
                              "  end\n"
                              "end\n";



  void
  show(const std::string              &mistake,
       const std::string              &text,
       const std::vector<std::string> &overrides = {})
  {
    std::cout << mistake << ":\n  ";
    try
      {
        Debond::Scene::from_text(text, overrides, "scene.prm");
        std::cout << "accepted\n";
      }
    catch (const Debond::InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }



  /** A line in the subsection @p name of a scene that is right otherwise. */
  std::string
  in(const std::string &name, const std::string &line)
  {
    return "subsection " + name + "\n  " + line + "\nend\n" + turning;
  }



  std::string
  turned_by(const std::string &expression)
  {
    return "subsection Chuck\nsubsection Rotation z\nset Value = " +
           expression + "\nend\nend\n";
  }



  void
  show_unreadable_texts()
  {
    show("nothing wrong", turning);
    show("empty text", "# only a comment\n");
    show("binary file",
         std::string("\x7f"
                     "ELF\0\1",
                     6));
    show("stray text", "Bone\n" + turning);
    show("no equals sign", "set Title\n" + turning);
    show("missing end", "subsection Bone\n  set Layer grading = 2\n");
    show("end too many", turning + "end\n");
    show("set twice",
         in("Bone", "set Layer grading = 2\n  set Layer  grading = 3"));
    show("missing file", "include no_such_file.prm\n");
  }



  void
  show_unknown_names()
  {
    show("misspelt entry", in("Bone", "set Young modul = 18000"));
    show("entry of another subsection", in("Bone", "set Radius = 2"));
    show("entry that nothing resembles", in("Bone", "set Colour = red"));
    show("misspelt subsection", in("Load step", "set Times = 0, 1"));
    show("subsection in the wrong place",
         "subsection Bone\n" + in("Implant", "set Radius = 2") + "end\n");
    show("unknown override", turning, {"Interface/Penalty=1800"});
  }



  void
  show_wrong_values()
  {
    show("unit after the number", in("Bone", "set Young modulus = 18 GPa"));
    show("unit glued to the number", in("Bone", "set Young modulus = 18GPa"));
    show("decimal comma", in("Bone", "set Poisson ratio = 0,3"));
    show("not a number", in("Bone", "set Young modulus = nan"));
    show("out of range", in("Bone", "set Poisson ratio = 0.5"));
    show("no value", in("Bone", "set Young modulus ="));
    show("too few numbers", in("Bone", "set Size = 12, 5"));
    show("broken whole number", in("Bone", "set Cells = 15, 15, 2.5"));
    show("unknown choice", in("Bone", "set Material = steel"));
    show("unknown task", "set Task = optimise\n" + turning);
    show("unknown in a scene that is simulated",
         "subsection Bone\n  set Young modulus = <<18000 in 1..2>>\nend\n" + turning);
    show("study", in("Bone", "set Young modulus = {{18000|21000}}"));
    show("wrong override", turning, {"Interface/Penalty stiffness=-1"});
    show("override without a value", turning, {"Interface/Penalty stiffness"});
  }



  void
  show_contradictions()
  {
    show("nothing moves", "set Title = still\n");
    show("expression", turned_by("10 * max(t - 1, 0"));
    show("expression with an unknown name", turned_by("10 * x"));
    show("expression with a decimal comma", turned_by("0,5 * t"));
    show("expression without a value", turned_by("1/(t - 1)"));
    show("times that do not increase", in("Load steps", "set Times = 0, 2, 1"));
    show("times without steps", in("Load steps", "set Times = 0, 1"));
    show("implant wider than bone", in("Implant", "set Radius = 7"));
    show("three numbers of cells for a coin",
         in("Implant", "set Cells = 3, 4, 2"));
    show("size of a coin", in("Implant", "set Size = 4, 4, 3"));
    show("radius of the sphere of a coin",
         in("Implant", "set Cap radius = 20"));
    show("steep cap",
         in("Implant", "set Shape = cap"),
         {"Implant/Cap radius=2"});
    show("low cap",
         in("Implant", "set Height = 0.5"),
         {"Implant/Shape=cap", "Implant/Cap radius=3"});
    show("thin cells", in("Bone", "set Lateral grading = 9"));
    show("too many cells", in("Bone", "set Cells = 2000, 2000, 2"));
    show("part of a homogeneous bond",
         turning,
         {"Interface/Bonding/Bonded fraction=0.5"});
    show("bonded disk under a block",
         turning,
         {"Implant/Shape=block",
          "Implant/Cells=4, 4, 2",
          "Interface/Bonding/Pattern=disk"});
    show("stiffness of a loaded component",
         turning,
         {"Chuck/Translation z/Control=force",
          "Chuck/Translation z/Value=-51.88",
          "Chuck/Translation z/Stiffness=1000"});
  }
} // namespace



int
main()
{
  show_unreadable_texts();
  show_unknown_names();
  show_wrong_values();
  show_contradictions();
}
