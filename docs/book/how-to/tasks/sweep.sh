striae new pad --template pad
striae sweep pad/deck.toml --vary turn=0,30,60,90 --workers 2 --out sweep
