export {
  AmbientLight, BufferAttribute, BufferGeometry, Color, ConeGeometry, CylinderGeometry,
  DataTexture, DirectionalLight, DoubleSide, HemisphereLight, InstancedMesh, LineBasicMaterial,
  LineSegments, LinearFilter, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial,
  NearestFilter, OrthographicCamera, PerspectiveCamera, Plane, Quaternion, Raycaster, RGBAFormat,
  Scene, Sphere, SRGBColorSpace, UnsignedByteType, Vector2, Vector3, WebGLRenderer,
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
