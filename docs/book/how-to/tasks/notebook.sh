python3 -m venv lab
lab/bin/pip install striae matplotlib jupyterlab
lab/bin/jupyter lab friction_rosette.ipynb
