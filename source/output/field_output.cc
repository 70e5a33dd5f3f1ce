#include <debond/interface/contact_interface.h>
#include <debond/output/bulk_fields.h>
#include <debond/output/field_output.h>
#include <debond/output/result_files.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <regex>
#include <sstream>

namespace Debond
{
  FieldOutput::FieldOutput(const ResultDirectory  &directory,
                           const Body             &bone,
                           const Body             &implant,
                           const ContactInterface &interface,
                           const Chuck            &chuck)
    : directory(directory)
    , bodies{{&bone, &implant}}
    , interface(interface)
    , chuck(chuck)
  {}



  namespace
  {
    const std::string all_series[] = {"bulk", "interface", "points"};



    std::string
    base_name(const std::string &series, const unsigned int number)
    {
      return series + "-" + dealii::Utilities::int_to_string(number, 4);
    }



    std::string
    piece_name(const unsigned int number, const unsigned int rank)
    {
      return base_name("bulk", number) + "." + std::to_string(rank) + ".vtu";
    }
  } // namespace



  // Where several ranks drew the bulk it is the list of their pieces. A number
  // that is still to be written is that of the ranks at work.
  std::string
  FieldOutput::file_name(const std::string &series,
                         const unsigned int number) const
  {
    const unsigned int pieces =
      number < n_pieces.size() ? n_pieces[number] : Ranks::number();
    return base_name(series, number) +
           (series == "bulk" && pieces > 1 ? ".pvtu" : ".vtu");
  }



  void
  FieldOutput::write(const double time)
  {
    const Body        &slave  = *bodies[interface.slave_side()];
    const unsigned int number = times.size();
    const BulkFields   bulk(bodies, chuck);
    if (bulk.tension().MPa > largest_tension.MPa)
      {
        largest_tension      = bulk.tension();
        largest_tension.time = time;
      }
    if (Ranks::number() == 1)
      write_file(directory.file(file_name("bulk", number)), bulk.vtu());
    else
      {
        write_own_file(directory.file(piece_name(number, Ranks::own())),
                       bulk.vtu());
        std::vector<std::string> pieces;
        for (unsigned int rank = 0; rank < Ranks::number(); ++rank)
          pieces.push_back(piece_name(number, rank));
        write_file(directory.file(file_name("bulk", number)),
                   bulk.list_of_pieces(pieces));
      }
    if (Ranks::is_first())
      {
        write_file(directory.file(file_name("interface", number)),
                   interface_vtu(slave, interface, chuck));
        write_file(directory.file(file_name("points", number)),
                   points_vtu(slave, interface, chuck));
      }
    times.push_back(time);
    n_pieces.push_back(Ranks::number());
    write_series();
  }



  nlohmann::ordered_json
  FieldOutput::measures() const
  {
    if (largest_tension.MPa == 0.)
      return nlohmann::ordered_json::object();
    return {{"bone_tension_MPa", largest_tension.MPa},
            {"bone_tension_at_mm", largest_tension.X_mm},
            {"bone_tension_time", largest_tension.time}};
  }



  void
  FieldOutput::write_series() const
  {
    for (const std::string &series : all_series)
      {
        // deal.II's write_pvd_record() would add the date
        Classic<std::ostringstream> record;
        record.precision(12);
        record << "<?xml version=\"1.0\"?>\n"
                  "<VTKFile type=\"Collection\" version=\"0.1\">\n"
                  "  <Collection>\n";
        for (unsigned int i = 0; i < times.size(); ++i)
          record << "    <DataSet timestep=\"" << times[i] << "\" file=\""
                 << file_name(series, i) << "\"/>\n";
        record << "  </Collection>\n"
                  "</VTKFile>\n";
        write_file(directory.file(series + ".pvd"), record.str());
      }
  }



  std::string
  FieldOutput::forget_later_files()
  {
    namespace fs = std::filesystem;
    // of any number of ranks
    static const std::regex later(
      "(bulk|interface|points)-([0-9]+)(\\.[0-9]+)?\\.p?vtu");
    const fs::directory_iterator files(directory.path());
    if (Ranks::is_first())
      for (const fs::path &file :
           std::vector<fs::path>(fs::begin(files), fs::end(files)))
        {
          const std::string name = file.filename().string();
          std::smatch       parts;
          std::error_code   none;
          if (std::regex_match(name, parts, later) &&
              std::stoul(parts[2]) >= times.size())
            fs::remove(file, none);
        }
    std::string missing;
    for (const std::string &series : all_series)
      for (unsigned int i = 0; i < times.size(); ++i)
        if (const std::string name = file_name(series, i);
            !fs::exists(directory.file(name)))
          missing += (missing.empty() ? "" : ", ") + name;
    write_series();
    n_on_disk = times.size();
    return missing.empty() ?
             "" :
             "VTU files from before the checkpoint are missing, "
             "and are not written again: " +
               missing;
  }



  void
  FieldOutput::put_on_disk()
  {
    for (; n_on_disk < times.size(); ++n_on_disk)
      for (const std::string &series : all_series)
        Debond::put_on_disk(directory.file(file_name(series, n_on_disk)));
  }
} // namespace Debond
