#include <debond/interface/contact_interface.h>
#include <debond/output/field_output.h>
#include <debond/output/result_files.h>

#include <deal.II/base/utilities.h>

#include <filesystem>
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



  void
  FieldOutput::write(const double time)
  {
    append(bulk_series, time, bulk_vtu(bodies, chuck));
    append(interface_series,
           time,
           interface_vtu(*bodies[interface.slave_side()], interface, chuck));
  }



  void
  FieldOutput::append(Series            &series,
                      const double       time,
                      const std::string &vtu) const
  {
    const std::string name = file_name(series, series.files.size());
    write_file(directory.file(name), vtu);
    series.files.emplace_back(time, name);
    write_series(series);
  }



  std::string
  FieldOutput::file_name(const Series &series, const unsigned int number) const
  {
    return series.name + "-" + dealii::Utilities::int_to_string(number, 4) +
           ".vtu";
  }



  void
  FieldOutput::write_series(const Series &series) const
  {
    // deal.II's write_pvd_record() would add the date
    std::ostringstream record;
    record.precision(12);
    record << "<?xml version=\"1.0\"?>\n"
              "<VTKFile type=\"Collection\" version=\"0.1\">\n"
              "  <Collection>\n";
    for (const auto &[file_time, file] : series.files)
      record << "    <DataSet timestep=\"" << file_time << "\" file=\"" << file
             << "\"/>\n";
    record << "  </Collection>\n"
              "</VTKFile>\n";
    write_file(directory.file(series.name + ".pvd"), record.str());
  }



  std::string
  FieldOutput::forget_later_files()
  {
    std::string missing;
    for (const Series *series : {&bulk_series, &interface_series})
      {
        unsigned int    number = series->files.size();
        std::error_code none;
        while (
          std::filesystem::remove(directory.file(file_name(*series, number)),
                                  none))
          ++number;
        write_series(*series);
        for (const auto &file : series->files)
          if (!std::filesystem::exists(directory.file(file.second)))
            missing += (missing.empty() ? "" : ", ") + file.second;
      }
    n_on_disk = bulk_series.files.size();
    return missing.empty() ?
             "" :
             "VTU files from before the checkpoint are missing, "
             "and are not written again: " +
               missing;
  }



  void
  FieldOutput::put_on_disk()
  {
    for (; n_on_disk < bulk_series.files.size(); ++n_on_disk)
      for (const Series *series : {&bulk_series, &interface_series})
        Debond::put_on_disk(directory.file(series->files[n_on_disk].second));
  }
} // namespace Debond
