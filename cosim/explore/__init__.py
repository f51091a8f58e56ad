"""The explorer: a page in which the mechanics runs in the browser, with a slider for every number.

`controls` makes the sliders of the declarations, `page` the one file of it all: the kernel as
WebAssembly, scenarios to begin with, and the scripts in the folder `page`, which are plain
JavaScript and are put in as they are.
"""
