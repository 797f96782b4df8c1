striae convert assembly.inp
striae check assembly.toml
striae run assembly.toml --report
striae picture results/assembly --out assembly.png
striae picture results/assembly --animate --out assembly.gif
