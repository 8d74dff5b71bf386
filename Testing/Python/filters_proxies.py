"""Names and defaults of the proxies: the panel starts with the values that the classes start with."""
import re

import numpy

import scenes

simple = scenes.load_plugin()
PROXIES = {
    "ExitSign": (), "Luminaire": (), "SmokeLightField": ("Smoke", "Surfaces", "Emitters"),
    "VisibilityImage": ("LightField",), "FloorMapOfVisibility": ("LightField",)}


def numbers(text):
    return [float(part) for part in re.findall(r"-?[0-9]+(?:\.[0-9]+)?(?:e[-+]?[0-9]+)?", text)]


for name, inputs in PROXIES.items():
    light = scenes.tunnel() if inputs == ("LightField",) else None
    arguments = {"LightField": light} if light else {}
    if "Smoke" in inputs:
        arguments = {"Smoke": scenes.producer(scenes.image((2, 2, 2), (1, 1, 1)), "Smoke")}
    proxy = getattr(simple, name)(**arguments)
    printed = dict(re.findall(r"^\s*(\w+): (.*)$", str(proxy.GetClientSideObject().NewInstance()),
                              re.MULTILINE))
    checked = 0
    for key in proxy.ListProperties():
        if key in inputs:
            continue
        value = proxy.GetProperty(key)
        documentation = " ".join(value.SMProperty.GetDocumentation().GetDescription().split())
        assert "Default: " in documentation, (name, key)
        default = value.GetData() if len(value) > 1 else [value.SMProperty.GetElement(0)]
        assert key in printed, (name, key, "is not printed")
        if printed[key] == "(none)":
            assert not default or default[0] in ("", None), (name, key, default)
        elif isinstance(default[0], str):
            assert printed[key] == default[0], (name, key, printed[key], default)
            assert documentation.split("Default: ")[1].startswith(default[0]), (name, key)
        else:
            assert numpy.allclose(numbers(printed[key]), [float(d) for d in default]), \
                (name, key, printed[key], default)
            stated = documentation.split("Default: ")[1].strip()
            if re.match(r"[-(0-9]", stated):
                assert numpy.allclose(numbers(stated)[:len(default)],
                                      [float(d) for d in default]), (name, key, stated, default)
        checked += 1
    assert checked >= 7, (name, checked)
    for key in inputs:
        assert proxy.GetProperty(key) is not None, (name, key)
print("proxies: passed")
