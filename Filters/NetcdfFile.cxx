// Writes NetCDF files.
#include "NetcdfFile.h"

#include "Errors.h"

#include <vtk_netcdf.h>

#include <cstdio>

namespace smokevis
{

const int NetcdfFile::Whole = NC_GLOBAL;

//------------------------------------------------------------------------------
NetcdfFile::NetcdfFile(const std::string& path) : Path_(path)
{
  this->Check(nc_create(path.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &this->Id_));
  this->Open_ = true;
}

//------------------------------------------------------------------------------
NetcdfFile::~NetcdfFile()
{
  if (this->Open_)
  {
    nc_abort(this->Id_);
    std::remove(this->Path_.c_str());
  }
}

//------------------------------------------------------------------------------
void NetcdfFile::Check(int status) const
{
  if (status != NC_NOERR)
  {
    throw Error("file '" + this->Path_ + "'", nc_strerror(status),
      "Check the folder, its permissions and the space that is left");
  }
}

//------------------------------------------------------------------------------
int NetcdfFile::Dimension(const std::string& name, std::size_t length)
{
  int id = 0;
  this->Check(nc_def_dim(this->Id_, name.c_str(), length == 0 ? NC_UNLIMITED : length, &id));
  return id;
}

//------------------------------------------------------------------------------
int NetcdfFile::Variable(const std::string& name, Type type, const std::vector<int>& dimensions)
{
  const nc_type known[] = {NC_CHAR, NC_INT, NC_FLOAT, NC_DOUBLE};
  int id = 0;
  this->Check(nc_def_var(this->Id_, name.c_str(), known[static_cast<int>(type)],
    static_cast<int>(dimensions.size()), dimensions.data(), &id));
  return id;
}

//------------------------------------------------------------------------------
void NetcdfFile::Attribute(int variable, const std::string& name, const std::string& text)
{
  this->Check(nc_put_att_text(this->Id_, variable, name.c_str(), text.size(), text.c_str()));
}

//------------------------------------------------------------------------------
void NetcdfFile::Attribute(int variable, const std::string& name, double value)
{
  this->Check(nc_put_att_double(this->Id_, variable, name.c_str(), NC_DOUBLE, 1, &value));
}

//------------------------------------------------------------------------------
void NetcdfFile::Attribute(int variable, const std::string& name, const std::vector<int>& values)
{
  this->Check(
    nc_put_att_int(this->Id_, variable, name.c_str(), NC_INT, values.size(), values.data()));
}

//------------------------------------------------------------------------------
void NetcdfFile::EndDefinitions()
{
  this->Check(nc_enddef(this->Id_));
}

//------------------------------------------------------------------------------
void NetcdfFile::Write(int variable, const std::vector<std::size_t>& start,
  const std::vector<std::size_t>& count, const double* values)
{
  this->Check(nc_put_vara_double(this->Id_, variable, start.data(), count.data(), values));
}

//------------------------------------------------------------------------------
void NetcdfFile::Write(int variable, const std::vector<std::size_t>& start,
  const std::vector<std::size_t>& count, const char* text)
{
  this->Check(nc_put_vara_text(this->Id_, variable, start.data(), count.data(), text));
}

//------------------------------------------------------------------------------
void NetcdfFile::Finish()
{
  this->Check(nc_close(this->Id_));
  this->Open_ = false;
}

} // namespace smokevis
