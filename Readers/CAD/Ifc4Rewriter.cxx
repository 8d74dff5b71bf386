// Rewrites the geometry of IFC4 (ISO 16739:2018, IfcGeometricModelResource) as IFC2x3.
#include "Ifc4Rewriter.h"

#include "StepRecord.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <vector>

namespace smokevis
{
namespace
{

constexpr std::string_view Schema = "FILE_SCHEMA";

/// Shapes that IFC2x3 has no words for.
constexpr std::array<std::string_view, 6> Unreadable = {"IFCADVANCEDBREP",
  "IFCADVANCEDBREPWITHVOIDS", "IFCEXTRUDEDAREASOLIDTAPERED", "IFCREVOLVEDAREASOLIDTAPERED",
  "IFCFIXEDREFERENCESWEPTAREASOLID", "IFCSECTIONEDSOLIDHORIZONTAL"};

using Records = std::map<std::string_view, std::string_view>;

/// A number that counts something; 0 for what is none.
std::size_t Count(std::string_view field)
{
  constexpr double most = 1e15;
  const double value = RecordNumber(field);
  return value >= 1.0 && value <= most ? static_cast<std::size_t>(value) : 0;
}

/// Whole numbers of a list, `(1,2,3)`.
std::vector<std::size_t> Indices(std::string_view list)
{
  std::vector<std::size_t> indices;
  for (const std::string_view field : SplitRecord(list).Fields)
  {
    indices.push_back(Count(field));
  }
  return indices;
}

class Rewriter
{
public:
  Rewriter(std::string_view text, double angle)
      : Text_(text), Step_(std::max(angle, 0.5) * std::numbers::pi / 180.0)
  {
  }

  std::string Run()
  {
    this->Collect();
    std::ostringstream out;
    out.precision(17);
    this->Out_ = &out;
    ForEachRecord(this->Text_,
      [&](std::string_view number, std::string_view body, std::string_view statement)
      {
        const StepRecord record = number.empty() ? StepRecord() : SplitRecord(body);
        if (statement.find(Schema) != std::string_view::npos && number.empty())
        {
          out << "\nFILE_SCHEMA(('IFC2X3'));";
        }
        else if (record.Name == "IFCTRIANGULATEDFACESET" && record.Fields.size() >= 4)
        {
          this->FaceSet(number, record.Fields[0], this->Triangles(record));
        }
        else if (record.Name == "IFCPOLYGONALFACESET" && record.Fields.size() >= 3)
        {
          this->FaceSet(number, record.Fields[0], this->Polygons(record));
        }
        else if (record.Name == "IFCINDEXEDPOLYCURVE" && record.Fields.size() >= 2)
        {
          this->Curve(number, record);
        }
        else if (record.Name == "IFCSTYLEDITEM" && record.Fields.size() == 3)
        {
          this->Style(number, record);
        }
        else if (std::find(Unreadable.begin(), Unreadable.end(), record.Name) != Unreadable.end())
        {
          // Something without area stands in for it: the library fails on references to nothing.
          ++this->Unread_;
          const std::size_t point = this->Begin("IFCCARTESIANPOINT");
          out << "(0.,0.,0.));";
          const std::size_t loop = this->Begin("IFCPOLYLOOP");
          this->List({point, point, point});
          out << ");";
          const std::size_t bound = this->Begin("IFCFACEOUTERBOUND");
          out << "#" << loop << ",.T.);";
          const std::size_t face = this->Begin("IFCFACE");
          out << "(#" << bound << "));";
          const std::size_t set = this->Begin("IFCCONNECTEDFACESET");
          out << "(#" << face << "));\n"
              << number << "=IFCFACEBASEDSURFACEMODEL((#" << set << "));";
        }
        else if (this->Lists_.count(number) == 0 && this->Faces_.count(number) == 0)
        {
          out << statement;
        }
      });
    return out.str();
  }

  std::size_t Unread() const { return this->Unread_; }

private:
  using Loops = std::vector<std::vector<std::size_t>>;

  void Collect()
  {
    ForEachRecord(this->Text_,
      [&](std::string_view number, std::string_view body, std::string_view)
      {
        if (number.empty())
        {
          return;
        }
        this->Next_ = std::max(this->Next_, Count(number.substr(1)));
        const std::string_view name = body.substr(0, body.find('('));
        if (name == "IFCCARTESIANPOINTLIST3D" || name == "IFCCARTESIANPOINTLIST2D")
        {
          this->Lists_.emplace(number, body);
        }
        else if (name == "IFCINDEXEDPOLYGONALFACE" || name == "IFCINDEXEDPOLYGONALFACEWITHVOIDS")
        {
          this->Faces_.emplace(number, body);
        }
        else if (name == "IFCSURFACESTYLE")
        {
          this->Styles_.insert(number);
        }
      });
  }

  /// Begins a new record and returns its number.
  std::size_t Begin(std::string_view name)
  {
    ++this->Next_;
    *this->Out_ << "\n#" << this->Next_ << "=" << name << "(";
    return this->Next_;
  }

  /// The coordinates in a list, as they are written.
  std::vector<std::string_view> Coordinates(std::string_view list) const
  {
    const auto found = this->Lists_.find(list);
    if (found == this->Lists_.end())
    {
      return {};
    }
    const StepRecord record = SplitRecord(found->second);
    return record.Fields.empty() ? std::vector<std::string_view>()
                                 : SplitRecord(record.Fields[0]).Fields;
  }

  static Loops Remap(Loops loops, std::string_view map)
  {
    const std::vector<std::size_t> indices = Indices(map);
    for (std::vector<std::size_t>& loop : loops)
    {
      for (std::size_t& index : loop)
      {
        index = indices.empty()                        ? index
                : index <= indices.size() && index > 0 ? indices[index - 1]
                                                       : 0;
      }
    }
    return loops;
  }

  static Loops Triangles(const StepRecord& record)
  {
    Loops loops;
    for (const std::string_view triangle : SplitRecord(record.Fields[3]).Fields)
    {
      loops.push_back(Indices(triangle));
    }
    return Remap(std::move(loops), record.Fields.size() > 4 ? record.Fields[4] : "$");
  }

  /// The outlines; what a face leaves out of itself comes with the face around it.
  Loops Polygons(const StepRecord& record) const
  {
    Loops loops;
    for (const std::string_view face : SplitRecord(record.Fields[2]).Fields)
    {
      const auto found = this->Faces_.find(face);
      if (found != this->Faces_.end())
      {
        const StepRecord outline = SplitRecord(found->second);
        loops.push_back(
          outline.Fields.empty() ? std::vector<std::size_t>() : Indices(outline.Fields[0]));
        // Holes follow as loops that begin with 0.
        for (std::size_t i = 1; i < outline.Fields.size(); ++i)
        {
          for (const std::string_view hole : SplitRecord(outline.Fields[i]).Fields)
          {
            loops.push_back(Indices(hole));
            loops.back().insert(loops.back().begin(), 0);
          }
        }
      }
    }
    return Remap(std::move(loops), record.Fields.size() > 3 ? record.Fields[3] : "$");
  }

  void FaceSet(std::string_view number, std::string_view list, const Loops& loops)
  {
    const std::size_t first = this->Next_ + 1;
    const std::vector<std::string_view> points = this->Coordinates(list);
    for (const std::string_view point : points)
    {
      this->Begin("IFCCARTESIANPOINT");
      *this->Out_ << point << ");";
    }
    std::vector<std::vector<std::size_t>> faces;
    for (const std::vector<std::size_t>& loop : loops)
    {
      const bool hole = !loop.empty() && loop[0] == 0;
      const std::size_t polygon = this->Begin("IFCPOLYLOOP");
      const char* separator = "(";
      for (std::size_t i = hole ? 1 : 0; i < loop.size(); ++i)
      {
        if (loop[i] > 0 && loop[i] <= points.size())
        {
          *this->Out_ << separator << "#" << first + loop[i] - 1;
          separator = ",";
        }
      }
      *this->Out_ << (*separator == '(' ? "(" : "") << "));";
      const std::size_t bound = this->Begin(hole ? "IFCFACEBOUND" : "IFCFACEOUTERBOUND");
      *this->Out_ << "#" << polygon << ",.T.);";
      if (!hole || faces.empty())
      {
        faces.emplace_back();
      }
      faces.back().push_back(bound);
    }
    std::vector<std::size_t> ids;
    for (const std::vector<std::size_t>& bounds : faces)
    {
      ids.push_back(this->Begin("IFCFACE"));
      this->List(bounds);
      *this->Out_ << ");";
    }
    const std::size_t set = this->Begin("IFCCONNECTEDFACESET");
    this->List(ids);
    *this->Out_ << ");\n" << number << "=IFCFACEBASEDSURFACEMODEL((#" << set << "));";
  }

  void List(const std::vector<std::size_t>& numbers)
  {
    const char* separator = "(";
    for (const std::size_t number : numbers)
    {
      *this->Out_ << separator << "#" << number;
      separator = ",";
    }
    *this->Out_ << (numbers.empty() ? "()" : ")");
  }

  using Point = std::array<double, 2>;

  /// The points of an arc behind its first one, through the second to the third.
  std::vector<Point> Arc(const Point& a, const Point& b, const Point& c) const
  {
    const double d = 2.0 * (a[0] * (b[1] - c[1]) + b[0] * (c[1] - a[1]) + c[0] * (a[1] - b[1]));
    const double aa = a[0] * a[0] + a[1] * a[1];
    const double bb = b[0] * b[0] + b[1] * b[1];
    const double cc = c[0] * c[0] + c[1] * c[1];
    const Point centre = {(aa * (b[1] - c[1]) + bb * (c[1] - a[1]) + cc * (a[1] - b[1])) / d,
      (aa * (c[0] - b[0]) + bb * (a[0] - c[0]) + cc * (b[0] - a[0])) / d};
    if (!std::isfinite(centre[0]) || !std::isfinite(centre[1]))
    {
      return {b, c};
    }
    const double radius = std::hypot(a[0] - centre[0], a[1] - centre[1]);
    const auto angle = [&](const Point& p)
    { return std::atan2(p[1] - centre[1], p[0] - centre[0]); };
    constexpr double turn = 2.0 * std::numbers::pi;
    const auto ahead = [&](double to, double from)
    {
      const double difference = std::fmod(to - from, turn);
      return difference < 0.0 ? difference + turn : difference;
    };
    const double start = angle(a);
    double sweep = ahead(angle(c), start);
    if (ahead(angle(b), start) > sweep)
    {
      sweep -= turn;
    }
    const int pieces = std::max(2, static_cast<int>(std::ceil(std::abs(sweep) / this->Step_)));
    std::vector<Point> points;
    for (int i = 1; i < pieces; ++i)
    {
      const double at = start + sweep * i / pieces;
      points.push_back({centre[0] + radius * std::cos(at), centre[1] + radius * std::sin(at)});
    }
    points.push_back(c);
    return points;
  }

  void Curve(std::string_view number, const StepRecord& record)
  {
    std::vector<Point> listed;
    const std::vector<std::string_view> texts = this->Coordinates(record.Fields[0]);
    for (const std::string_view text : texts)
    {
      const StepRecord point = SplitRecord(text);
      listed.push_back(point.Fields.size() >= 2
                         ? Point{RecordNumber(point.Fields[0]), RecordNumber(point.Fields[1])}
                         : Point{0.0, 0.0});
    }
    std::vector<std::size_t> ids;
    const auto add = [&](const Point& point)
    {
      ids.push_back(this->Begin("IFCCARTESIANPOINT"));
      // A number of this format has a decimal point or an exponent.
      *this->Out_ << "(" << std::scientific << point[0] << "," << point[1] << std::defaultfloat
                  << "));";
    };
    if (record.Fields[1] == "$")
    {
      std::for_each(listed.begin(), listed.end(), add);
    }
    for (const std::string_view segment : SplitRecord(record.Fields[1]).Fields)
    {
      const StepRecord kind = SplitRecord(segment);
      const std::vector<std::size_t> at =
        kind.Fields.empty() ? std::vector<std::size_t>() : Indices(kind.Fields[0]);
      if (std::any_of(
            at.begin(), at.end(), [&](std::size_t i) { return i == 0 || i > listed.size(); }) ||
          at.size() < 2)
      {
        continue;
      }
      if (ids.empty())
      {
        add(listed[at[0] - 1]);
      }
      if (kind.Name == "IFCARCINDEX" && at.size() == 3)
      {
        const auto arc = this->Arc(listed[at[0] - 1], listed[at[1] - 1], listed[at[2] - 1]);
        std::for_each(arc.begin(), arc.end(), add);
      }
      else
      {
        std::for_each(at.begin() + 1, at.end(), [&](std::size_t i) { add(listed[i - 1]); });
      }
    }
    *this->Out_ << "\n" << number << "=IFCPOLYLINE(";
    this->List(ids);
    *this->Out_ << ");";
  }

  /// IFC2x3 wants an assignment between an item and its style.
  void Style(std::string_view number, const StepRecord& record)
  {
    std::vector<std::string> styles;
    for (const std::string_view style : SplitRecord(record.Fields[1]).Fields)
    {
      if (this->Styles_.count(style) > 0)
      {
        const std::size_t assignment = this->Begin("IFCPRESENTATIONSTYLEASSIGNMENT");
        *this->Out_ << "(" << style << "));";
        styles.push_back("#" + std::to_string(assignment));
      }
      else
      {
        styles.emplace_back(style);
      }
    }
    *this->Out_ << "\n" << number << "=IFCSTYLEDITEM(" << record.Fields[0] << ",(";
    for (std::size_t i = 0; i < styles.size(); ++i)
    {
      *this->Out_ << (i > 0 ? "," : "") << styles[i];
    }
    *this->Out_ << ")," << record.Fields[2] << ");";
  }

  std::string_view Text_;
  double Step_;
  std::ostringstream* Out_ = nullptr;
  Records Lists_;
  Records Faces_;
  std::set<std::string_view> Styles_;
  std::size_t Unread_ = 0;
  /// The highest number in use.
  std::size_t Next_ = 0;
};

} // namespace

//------------------------------------------------------------------------------------------------
std::string RewriteIfc4(std::string_view text, double angle, std::size_t& unread)
{
  const std::size_t schema = text.find(Schema);
  const std::size_t end = schema == std::string_view::npos ? schema : text.find(';', schema);
  if (end == std::string_view::npos ||
      text.substr(schema, end - schema).find("IFC4") == std::string_view::npos)
  {
    return {};
  }
  Rewriter rewriter(text, angle);
  std::string result = rewriter.Run();
  unread = rewriter.Unread();
  return result;
}

} // namespace smokevis
