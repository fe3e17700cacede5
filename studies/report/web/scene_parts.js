// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What the scene is made of: polyhedra from polygon faces, bodies gathered into instanced meshes, and light.

import * as THREE from 'three';

const mostOutlined = 4; // shapes of fewer bodies than this get their edges drawn: machine parts, not rocks

export function geometry({vertices, faces}) {
  const corners = [];
  for (const face of faces)
    for (let k = 1; k + 1 < face.length; ++k)
      corners.push(...vertices[face[0]], ...vertices[face[k]], ...vertices[face[k + 1]]);
  const g = new THREE.BufferGeometry();
  g.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
  g.computeVertexNormals();
  return g;
}

/// One instanced mesh a (shape, opacity): {mesh, members: body numbers, edges}.
export function groups(panel) {
  const found = new Map();
  panel.bodies.forEach((body, index) => {
    const opacity = body.opacity ?? 1;
    const key = body.shape + '/' + opacity;
    if (!found.has(key)) found.set(key, {shape: body.shape, opacity, members: []});
    found.get(key).members.push(index);
  });
  return [...found.values()].map((group) => build(panel, group));
}

function build(panel, {shape, opacity, members}) {
  const shell = opacity < 1;
  const surface = geometry(panel.shapes[shape]);
  const material = new THREE.MeshLambertMaterial({
    color: '#ffffff',
    transparent: shell,
    opacity,
    depthWrite: !shell,
    side: THREE.DoubleSide,
  });
  const mesh = new THREE.InstancedMesh(surface, material, members.length);
  mesh.frustumCulled = false;
  mesh.castShadow = !shell;
  mesh.receiveShadow = true;
  mesh.renderOrder = shell ? 1 : 0;
  members.forEach((body, i) => mesh.setColorAt(i, new THREE.Color(panel.bodies[body].color ?? '#8d8a85')));
  return {mesh, members, edges: members.length <= mostOutlined ? outlines(surface, members.length, shell) : []};
}

function outlines(surface, count, shell) {
  const edges = new THREE.EdgesGeometry(surface, 20);
  const material = new THREE.LineBasicMaterial({
    color: shell ? '#7d8a95' : '#20262c',
    transparent: true,
    opacity: shell ? 0.45 : 0.35,
  });
  return Array.from({length: count}, () =>
    Object.assign(new THREE.LineSegments(edges, material), {matrixAutoUpdate: false, frustumCulled: false}),
  );
}

/// Sun and sky; the sun's shadow covers the sphere given.
export function lights(centre, radius) {
  const sun = new THREE.DirectionalLight('#fff4e6', 3.2);
  sun.position.copy(centre).add(new THREE.Vector3(-0.45, -0.55, 1.0).normalize().multiplyScalar(2.5 * radius));
  sun.target.position.copy(centre);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.normalBias = 0.02;
  Object.assign(sun.shadow.camera, {
    left: -radius,
    right: radius,
    top: radius,
    bottom: -radius,
    near: 0.1,
    far: 5 * radius,
  });
  const sky = new THREE.HemisphereLight('#eef4fa', '#9a8c7c', 1.7);
  sky.position.set(0, 0, 1);
  return [sun, sun.target, sky];
}
