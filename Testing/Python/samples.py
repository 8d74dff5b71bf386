"""Small files of each kind that describes a lamp, a camera and a sign."""
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

# A lamp by IES LM-63, 0.5 m square, of about 500 lm downwards.
IES = """IESNA:LM-63-2002
[TEST] none
TILT=NONE
1 1000 1 5 1 1 2 0.5 0.5 0
1 1 50
0 22.5 45 67.5 90
0
300 280 200 90 10
"""
# The response of a camera: exposure [lx s at ISO 100], pixel value.
RESPONSE = "exposure,pixel_value\n0.1,1\n1,20\n10,118\n100,255\n"


def png():
    """A small picture, written by VTK."""
    picture = vtkImageData()
    picture.SetDimensions(8, 4, 1)
    grey = vtkUnsignedCharArray()
    for pixel in range(32):
        grey.InsertNextValue(255 * (pixel % 2))
    picture.GetPointData().SetScalars(grey)
    writer = vtkPNGWriter()
    writer.SetInputData(picture)
    writer.WriteToMemoryOn()
    writer.Write()
    return bytes(memoryview(writer.GetResult()))
