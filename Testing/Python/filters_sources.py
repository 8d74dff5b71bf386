"""Signs and lamps: counts, areas, lit shares, normals, colours, tables, images, bad input."""
import math
import os
import tempfile

import numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolygon
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.util.numpy_support import numpy_to_vtk

import scenes
from scenes import cell_array, check_close, fetch

simple = scenes.load_plugin()


def polygons(data):
    """Area and unit normal of each cell."""
    areas, normals = [], []
    for i in range(data.GetNumberOfCells()):
        points = data.GetCell(i).GetPoints()
        normal = [0.0, 0.0, 0.0]
        vtkPolygon.ComputeNormal(points, normal)
        corners = numpy.array([points.GetPoint(j) for j in range(4)])
        areas.append(numpy.linalg.norm(numpy.cross(corners[1] - corners[0],
                                                   corners[3] - corners[0])))
        normals.append(normal)
    return numpy.array(areas), numpy.array(normals)


def check_defaults():
    data = fetch(simple.ExitSign())
    areas, normals = polygons(data)
    luminance = cell_array(data, "Luminance")
    assert data.GetNumberOfCells() == 9
    # Neighbouring cells share their corners, so there is neither gap nor overlap.
    assert data.GetNumberOfPoints() == 20
    check_close("plate", areas.sum(), 0.18, 1e-12)
    check_close("lit share", areas[luminance > 0].sum(), 0.18 * 5 / 9, 1e-12)
    assert numpy.allclose(normals, [1, 0, 0])
    assert list(luminance) == [300, 0] * 4 + [300]
    assert set(cell_array(data, "SignId")) == {0}
    assert set(cell_array(data, "Reflectance")) == {0}
    assert data.GetCellData().GetAbstractArray("SignName").GetValue(0) == "Sign 0"


def check_square():
    sign = simple.ExitSign(Pattern="Square", Normal=[0, -3, 0], Center=[1, 2, 3], SignId=7)
    data = fetch(sign)
    areas, normals = polygons(data)
    lit = cell_array(data, "Luminance") > 0
    assert data.GetNumberOfCells() == 9 and lit.sum() == 1
    check_close("lit square", areas[lit][0], 0.15 ** 2, 1e-12)
    check_close("plate", areas.sum(), 0.18, 1e-12)
    assert numpy.allclose(normals, [0, -1, 0])
    assert numpy.allclose(data.GetCenter(), [1, 2, 3])
    assert set(cell_array(data, "SignId")) == {7}
    # A square as large as the plate leaves no strips of zero width.
    sign.SquareFraction = 1.0
    sign.Width = sign.Height = 0.3
    assert fetch(sign).GetNumberOfCells() == 1


def check_colour():
    data = fetch(simple.ExitSign(Color=[0.0, 1.0, 0.2], Luminance=100, UnlitLuminance=10))
    luminance = cell_array(data, "Luminance")
    photopic = luminance @ [0.2126, 0.7152, 0.0722]
    assert numpy.allclose(photopic, [100, 10] * 4 + [100])
    assert numpy.allclose(luminance[:, 2], 0.2 * luminance[:, 1])


def write_png(path, values):
    """Rows of pixels, the bottom one first, with as many components as the last axis has."""
    image = vtkImageData()
    image.SetDimensions(values.shape[1], values.shape[0], 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(values.reshape(-1, values.shape[2]), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def linear(value):
    """IEC 61966-2-1."""
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def check_image(folder):
    grey = numpy.array([[0, 51, 255], [255, 0, 0]], dtype=numpy.uint8)
    path = os.path.join(folder, "stencil.png")
    write_png(path, grey[:, :, None])
    data = fetch(simple.ExitSign(Pattern="Image", PatternFile=path, Luminance=100,
                                 UnlitLuminance=50))
    areas, _ = polygons(data)
    # The two black pixels beside each other are one cell.
    assert numpy.allclose(areas, numpy.array([1, 1, 1, 1, 2]) * 0.18 / 6)
    assert numpy.allclose(cell_array(data, "Luminance"),
                          [50, 50 + 50 * linear(0.2), 100, 100, 50], rtol=1e-9)
    # The first cell is the lower left one as seen from the front: the front looks along +x with z up.
    corner = numpy.array(data.GetCell(0).GetPoints().GetPoint(0))
    assert numpy.allclose(corner, [0.0, -0.3, -0.15]), corner
    return path


def check_coloured_image(folder):
    """A pixel's share is its luminance: sRGB is made linear first, its colours weighted then."""
    pixels = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (128, 128, 128), (200, 30, 90), (255, 255, 0)]
    expected = [numpy.dot([0.2126, 0.7152, 0.0722], [linear(v / 255) for v in pixel])
                for pixel in pixels]
    path = os.path.join(folder, "colours.png")

    def shares():
        data = fetch(simple.ExitSign(Pattern="Image", PatternFile=path, Luminance=100))
        return cell_array(data, "Luminance") / 100

    write_png(path, numpy.array([pixels], dtype=numpy.uint8))
    assert numpy.allclose(shares(), expected, atol=1e-9), (shares(), expected)
    write_png(path, numpy.array([[[257 * v for v in p] for p in pixels]], dtype=numpy.uint16))
    assert numpy.allclose(shares(), expected, atol=1e-9), (shares(), expected)
    # Half transparent counts as half as bright, whatever is behind.
    write_png(path, numpy.array([[(255, 255, 255, 128), (255, 0, 0, 0), (255, 255, 255, 255)]],
                                dtype=numpy.uint8))
    assert numpy.allclose(shares(), [128 / 255, 0, 1], atol=1e-9), shares()


def check_table(folder):
    path = os.path.join(folder, "signs.csv")
    with open(path, "w") as table:
        table.write('# two signs\n\nid, name, cx, cy, cz, nx, ny, nz, width, pattern, bars\n'
                    '3, "Stairs, north", 1, 2, 2.5, 0, 1, 0, 0.4, Square, \n'
                    ',, -1, 0, 2, , , , , barcode, 5\n')
    data = fetch(simple.ExitSign(SignTable=path, SignId=10))
    ids = cell_array(data, "SignId")
    names = data.GetCellData().GetAbstractArray("SignName")
    areas, normals = polygons(data)
    assert list(ids) == [3] * 9 + [11] * 5
    assert names.GetValue(0) == "Stairs, north" and names.GetValue(9) == "Sign 11"
    check_close("first plate", areas[:9].sum(), 0.4 * 0.3, 1e-12)
    check_close("second plate", areas[9:].sum(), 0.6 * 0.3, 1e-12)
    assert numpy.allclose(normals[0], [0, 1, 0]) and numpy.allclose(normals[9], [1, 0, 0])
    # Line ends of any system, and the mark that some editors begin UTF-8 with.
    with open(path) as file:
        text = file.read()
    for change in (text.replace("\n", "\r\n"), text.replace("\n", "\r"), "\ufeff" + text,
                   text.replace("north", "n\u00f6rdlich")):
        other = os.path.join(folder, "other.csv")
        with open(other, "wb") as file:
            file.write(change.encode("utf-8"))
        data = fetch(simple.ExitSign(SignTable=other, SignId=10))
        assert list(cell_array(data, "SignId")) == [3] * 9 + [11] * 5, change
    assert data.GetCellData().GetAbstractArray("SignName").GetValue(0) == "Stairs, n\u00f6rdlich"
    return path


def check_lamps():
    data = fetch(simple.Luminaire(Center=[5, 5, 3], Count=[3, 2], Spacing=[2, 4],
                                  LuminousFlux=4000))
    areas, normals = polygons(data)
    assert data.GetNumberOfCells() == 6
    assert numpy.allclose(areas, 0.36)
    assert numpy.allclose(normals, [0, 0, -1])
    assert numpy.allclose(cell_array(data, "Luminance"), 4000 / (math.pi * 0.36))
    assert set(cell_array(data, "SignId")) == {-1}
    # Centred on the grid: 3 lamps 2 m apart, 2 lamps 4 m apart, 0.6 m wide.
    assert numpy.allclose(data.GetBounds(), [2.7, 7.3, 2.7, 7.3, 3, 3])


def check_error(what, source, class_name, part):
    """One message, which names the trouble, and no output."""
    with scenes.Messages() as messages:
        data = fetch(source)
        cells = data.GetNumberOfCells()
    assert messages.count("ERROR", class_name) == 1, (what, messages.text)
    assert part in messages.text, (what, messages.text)
    assert cells == 0, what


def check_errors(folder, image, table):
    def sign(what, part, **properties):
        check_error(what, simple.ExitSign(**properties), "vtkExitSignSource", part)

    sign("no normal", "normal has no direction", Normal=[0, 0, 0])
    sign("no width", "not a positive length", Width=0)
    sign("too many bars", "number of bars", Bars=10 ** 6)
    sign("negative id", "id is negative", SignId=-1)
    sign("no light", "luminance is negative", Luminance=-5)
    sign("reflectance", "outside 0 to 1", Reflectance=1.5)
    sign("black", "Color is black", Color=[0, 0, 0])
    sign("no file name", "no file is given", Pattern="Image")
    sign("missing file", "there is no such file", Pattern="Image",
         PatternFile=os.path.join(folder, "nothing.png"))
    sign("not an image", "not a PNG image", Pattern="Image", PatternFile=table)

    damaged = os.path.join(folder, "damaged.png")
    with open(image, "rb") as source, open(damaged, "wb") as target:
        target.write(source.read()[:50])
    sign("damaged image", "damaged", Pattern="Image", PatternFile=damaged)

    huge = os.path.join(folder, "huge.png")
    stencil = vtkImageData()
    stencil.SetDimensions(1000, 1000, 1)
    stencil.AllocateScalars(3, 1)
    stencil.GetPointData().GetScalars().Fill(0)
    writer = vtkPNGWriter()
    writer.SetFileName(huge)
    writer.SetInputData(stencil)
    writer.Write()
    sign("huge image", "1000 x 1000 pixels", Pattern="Image", PatternFile=huge)

    sign("missing table", "no such file", SignTable=os.path.join(folder, "nothing.csv"))
    for text, part in (("", "holds no sign"),
                       ("cx,cy,cz\n", "holds no sign"),
                       ("cx;cy;cz\n1;2;3\n", "line 1: the column"),
                       ("cx,cy\n1,2\n", "line 1: the column cz is missing"),
                       ("cx,cy, CX,cz\n1,2,3,4\n", "line 1: there are two columns 'cx'"),
                       ("cx,cy,cz,bars\n1,2,3,9\n\n1,2,3,9.5\n", "line 4: column bars holds '9.5'"),
                       ("cx,cy,cz\n1,2,3\n1,,3\n", "line 3: column cy is blank"),
                       ("cx,cy,cz\n1,2,nan\n", "line 2: column cz holds 'nan'"),
                       ("cx,cy,cz\n1,2,3,4\n", "line 2: it has more fields"),
                       ("id,cx,cy,cz\n1,1,2,3\n1,1,2,3\n", "line 3: id 1 was given in line 2"),
                       ("cx,cy,cz,pattern\n1,2,3,star\n", "line 2: the pattern 'star'"),
                       ("cx,cy,cz,width\n1,2,3,-1\n", "line 2, sign 0: its width")):
        path = os.path.join(folder, "bad.csv")
        with open(path, "w") as bad:
            bad.write(text)
        sign(text, part, SignTable=path)

    for length in range(0, 50, 7):
        with open(image, "rb") as source, open(damaged, "wb") as target:
            target.write(source.read()[:length])
        sign("image cut at %d" % length, "damaged", Pattern="Image", PatternFile=damaged)
    random = numpy.random.default_rng(1)
    for size in (10, 1000, 100000):
        with open(path, "wb") as bad:
            bad.write(random.bytes(size))
        sign("bytes", "sign table", SignTable=path)
    for encoding in ("utf-16", "utf-16-be"):
        with open(path, "wb") as file:
            file.write("cx,cy,cz\n1,2,3\n".encode(encoding))
        sign(encoding, "not as UTF-16", SignTable=path)
    with open(path, "wb") as file:
        file.write("# sch\u00f6n\ncx,cy,cz,name\n1,2,3,Nord\n4,5,6,S\u00fcd\n".encode("latin-1"))
    sign("latin-1 in a comment", "line 1: it holds a letter that is not UTF-8", SignTable=path)
    with open(path, "wb") as file:
        file.write("cx,cy,cz,name\r1,2,3,Nord\r4,5,6,S\u00fcd\r".encode("latin-1"))
    sign("latin-1", "line 3: it holds a letter that is not UTF-8", SignTable=path)
    for row in ('1,2,3,"East', '1,2,3,"Ea""st', '1,2,3,East"'):
        with open(path, "w") as file:
            file.write("cx,cy,cz,name\n1,2,3,North\n" + row + "\n4,5,6,South\n")
        sign(row, "line 3: a double quote is not closed", SignTable=path)

    def lamp(what, part, **properties):
        check_error(what, simple.Luminaire(**properties), "vtkLuminaireSource", part)

    lamp("overlap", "overlap", Count=[2, 1], Spacing=[0.5, 1])
    lamp("count", "Count is outside", Count=[0, 1])
    lamp("flux", "flux is negative", LuminousFlux=-1)
    lamp("size", "not a positive length", Height=-1)


check_defaults()
check_square()
check_colour()
check_lamps()
with tempfile.TemporaryDirectory() as temporary:
    check_coloured_image(temporary)
    check_errors(temporary, check_image(temporary), check_table(temporary))
print("signs and lamps: passed")
