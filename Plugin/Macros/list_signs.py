"""Lists the signs of the selected light field or sign source with their ids, for Target Sign."""
from smokevisibility import display

for number, name in display.signs():
    print("%3d  %s" % (number, name))
